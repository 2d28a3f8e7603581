// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A brain that is no ball, sags under an opening, and has a grid of electrodes laid on it.
///
/// Nothing of it is what the fit assumes: the shift is a bump of limited width along a direction
/// that is not the normal, with a swelling beside it, and no Gaussian process. The sheet is laid on
/// the bent cortex by springs between neighbours that are as long as the pitch, and not by
/// Gauss-Newton steps.
#ifndef BrainShift_SyntheticGrids_h
#define BrainShift_SyntheticGrids_h

#include "Filters/Electrodes/SheetFit.h"
#include "Filters/Fit/Anchors.h"
#include "Filters/Fit/Fit.h"

#include <cmath>
#include <random>

namespace brainshift::testing
{
/** A closed surface: an ellipsoid with waves of some mm. Positions are mm. */
class WavyCortex
{
public:
  /** Negative inside; a fraction, 0 on the surface. */
  static double level(const glm::dvec3& at)
  {
    const glm::dvec3 axes(67.0, 86.0, 58.0);
    const glm::dvec3 scaled = at / axes;
    const double radius = glm::length(scaled);
    const glm::dvec3 u = scaled / radius;
    return radius - 1.0 - 0.012 * std::sin(4.0 * u.x + 1.0) * std::cos(3.0 * u.y) -
      0.008 * std::cos(5.0 * u.z + 2.0 * u.x);
  }

  static glm::dvec3 gradient(const glm::dvec3& at)
  {
    constexpr double Step = 1e-4;
    glm::dvec3 result;
    for (int axis = 0; axis < 3; ++axis)
    {
      glm::dvec3 aside(0.0);
      aside[axis] = Step;
      result[axis] = (level(at + aside) - level(at - aside)) / (2.0 * Step);
    }
    return result;
  }

  /** The nearest point: onto the surface, then along it towards the position, and so on. */
  static SurfacePoint nearest(const glm::dvec3& position)
  {
    glm::dvec3 at = position;
    for (int i = 0; i < 25; ++i)
    {
      for (int j = 0; j < 2; ++j)
      {
        const glm::dvec3 g = gradient(at);
        at -= level(at) * g / glm::dot(g, g);
      }
      const glm::dvec3 normal = glm::normalize(gradient(at));
      const glm::dvec3 away = position - at;
      const glm::dvec3 along = away - normal * glm::dot(away, normal);
      if (glm::length(along) < 1e-7)
      {
        break;
      }
      at += 0.8 * along;
    }
    return { at, glm::normalize(gradient(at)) };
  }

  /** The point of the surface in a direction from the middle. */
  static SurfacePoint towards(const glm::dvec3& direction)
  {
    double low = 20.0;
    double high = 150.0;
    for (int i = 0; i < 60; ++i)
    {
      const double middle = 0.5 * (low + high);
      (level(middle * direction) < 0.0 ? low : high) = middle;
    }
    const glm::dvec3 at = low * direction;
    return { at, glm::normalize(gradient(at)) };
  }

  /** Points all over it. */
  static std::vector<SurfacePoint> points(int count)
  {
    std::vector<SurfacePoint> result;
    for (int i = 0; i < count; ++i)
    {
      const double z = 1.0 - (2.0 * i + 1.0) / count;
      const double turn = 2.399963229728653 * i; // the golden angle
      const double flat = std::sqrt(1.0 - z * z);
      result.push_back(towards({ flat * std::cos(turn), flat * std::sin(turn), z }));
    }
    return result;
  }
};

/** How the tissue moves. */
struct Sag
{
  glm::dvec3 centre{ 0.0 };    ///< mm, on the cortex at rest
  glm::dvec3 direction{ 0.0 }; ///< unit vector
  double depthMm = 0.0;
  double radiusMm = 45.0;  ///< nothing moves further away
  glm::dvec3 swell{ 0.0 }; ///< mm: the middle of a swelling
  glm::dvec3 swellBy{ 0.0 };
  double swellRadiusMm = 25.0;

  glm::dvec3 shift(const glm::dvec3& rest) const
  {
    const double away = std::min(1.0, glm::distance(rest, this->centre) / this->radiusMm);
    const double bump = std::pow(std::cos(0.5 * 3.14159265358979 * away), 2.0);
    const double near = std::min(1.0, glm::distance(rest, this->swell) / this->swellRadiusMm);
    const double lobe = std::pow(1.0 - near * near, 3.0);
    return this->depthMm * bump * this->direction + lobe * this->swellBy;
  }

  glm::dvec3 restFromBent(const glm::dvec3& bent) const
  {
    glm::dvec3 rest = bent;
    for (int i = 0; i < 60; ++i)
    {
      rest = bent - this->shift(rest);
    }
    return rest;
  }

  /** A point of the bent cortex near to a position. */
  glm::dvec3 onBentCortex(glm::dvec3 at) const
  {
    for (int i = 0; i < 4; ++i)
    {
      const SurfacePoint foot = WavyCortex::nearest(this->restFromBent(at));
      at = foot.position + this->shift(foot.position);
    }
    return at;
  }
};

/** What is known of a grid, and the truth. */
struct LaidGrid
{
  Sheet sheet; ///< all contacts, with noise
  std::vector<glm::dvec3> bent;
  std::vector<glm::dvec3> rest;
};

struct GridShape
{
  int rows = 8;
  int columns = 8;
  double pitchMm = 10.0;
  bool isLaidBefore = false; ///< whether it was laid on the cortex before that sagged
};

/** Where springs between neighbours of a sheet pull its contacts (mm). */
inline std::vector<glm::dvec3> pulls(const GridShape& shape, const std::vector<glm::dvec3>& at)
{
  const int count = shape.rows * shape.columns;
  std::vector<glm::dvec3> pull(count, glm::dvec3(0.0));
  const auto spring = [&](int a, int b, double length, double strength) {
    const glm::dvec3 apart = at[b] - at[a];
    const glm::dvec3 force = strength * (1.0 - length / glm::length(apart)) * apart;
    pull[a] += force;
    pull[b] -= force;
  };
  for (int k = 0; k < count; ++k)
  {
    const int row = k / shape.columns;
    const int column = k % shape.columns;
    const double diagonal = std::sqrt(2.0) * shape.pitchMm;
    if (column + 1 < shape.columns)
    {
      spring(k, k + 1, shape.pitchMm, 0.24);
    }
    if (row + 1 < shape.rows)
    {
      spring(k, k + shape.columns, shape.pitchMm, 0.24);
    }
    if (row + 1 < shape.rows && column + 1 < shape.columns)
    {
      spring(k, k + shape.columns + 1, diagonal, 0.005);
      spring(k + 1, k + shape.columns, diagonal, 0.005);
    }
  }
  return pull;
}

/** Lays a grid on the bent cortex. `turn`: radians; `aside`: mm from the middle of the sag. */
inline LaidGrid laidGrid(const GridShape& shape, const Sag& sag, double turn,
  const glm::dvec2& aside, double noiseMm, unsigned seed)
{
  const glm::dvec3 normal = WavyCortex::nearest(sag.centre).normal;
  const glm::dvec3 across = glm::normalize(glm::cross(normal, glm::dvec3(0.3, 0.9, 0.1)));
  const glm::dvec3 down = glm::cross(normal, across);
  const glm::dvec3 u = std::cos(turn) * across + std::sin(turn) * down;
  const glm::dvec3 v = std::cos(turn) * down - std::sin(turn) * across;
  LaidGrid grid;
  const Sag under = shape.isLaidBefore ? Sag() : sag;
  const int count = shape.rows * shape.columns;
  for (int k = 0; k < count; ++k)
  {
    const int row = k / shape.columns;
    const double x = shape.pitchMm * (k % shape.columns - 0.5 * (shape.columns - 1)) + aside.x;
    const double y = shape.pitchMm * (row - 0.5 * (shape.rows - 1)) + aside.y;
    grid.bent.push_back(under.onBentCortex(sag.centre + x * u + y * v));
  }
  for (int step = 0; step < 250; ++step)
  {
    const std::vector<glm::dvec3> pull = pulls(shape, grid.bent);
    for (int k = 0; k < count; ++k)
    {
      const glm::dvec3 to = grid.bent[k] + pull[k];
      grid.bent[k] = step % 5 == 4 ? under.onBentCortex(to) : to;
    }
  }
  for (glm::dvec3& bent : grid.bent)
  {
    grid.rest.push_back(under.restFromBent(bent));
    bent = grid.rest.back() + sag.shift(grid.rest.back());
  }
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, noiseMm);
  grid.sheet = { shape.rows, shape.columns, shape.pitchMm, {} };
  for (const glm::dvec3& bent : grid.bent)
  {
    grid.sheet.contacts.emplace_back(
      bent + glm::dvec3(noise(random), noise(random), noise(random)));
  }
  return grid;
}

/** A sag under an opening at some place of the head. */
inline Sag sagAt(const glm::dvec3& direction, double depthMm, double tiltDegrees, unsigned seed)
{
  std::mt19937 random(seed);
  std::normal_distribution<double> any;
  Sag sag;
  const SurfacePoint top = WavyCortex::towards(glm::normalize(direction));
  sag.centre = top.position;
  const glm::dvec3 aside =
    glm::normalize(glm::cross(top.normal, glm::dvec3(any(random), any(random), any(random))));
  const double tilt = glm::radians(tiltDegrees);
  sag.direction = -std::cos(tilt) * top.normal + std::sin(tilt) * aside;
  sag.depthMm = depthMm;
  sag.radiusMm = 52.0;
  sag.swell = top.position + 30.0 * glm::cross(top.normal, aside);
  sag.swellBy = 1.5 * top.normal;
  return sag;
}
}

#endif

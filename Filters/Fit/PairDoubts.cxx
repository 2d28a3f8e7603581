// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Fit/PairDoubts.h"

#include "Filters/Fit/OpenRotation.h"
#include "Filters/Fit/RigidPose.h"

#include <cstdio>
#include <limits>

namespace brainshift
{
namespace
{
constexpr double SamePlaceMm = 1e-3;
constexpr double ClosestMm = 1.0;       // extent of a list that is rather in metres
constexpr double FarthestRatio = 100.0; // of the extents of a list and the volume
constexpr double MostScale = 2.0;       // between two lists of the same tissue
constexpr double FarRotation = 0.8;     // rad: more is rather another frame
constexpr double NearRotation = 0.3;    // rad: of the frame that would fit
constexpr double ClearlyWorseMm = 2.0;  // RMS of a rotation above that of other axes

using Points = std::vector<glm::dvec3>;
using Sentences = std::vector<std::string>;

std::string rounded(double number)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.3g", number);
  return text;
}

double extentOf(const Points& points)
{
  glm::dvec3 least(std::numeric_limits<double>::max());
  glm::dvec3 most(std::numeric_limits<double>::lowest());
  for (const glm::dvec3& point : points)
  {
    least = glm::min(least, point);
    most = glm::max(most, point);
  }
  return points.empty() ? 0.0 : glm::distance(least, most);
}

// A rotation that takes points to others, how far it turns (rad) and what it leaves (RMS, mm).
struct Match
{
  double angle = 0.0;
  double rms = 0.0;
};

Match matchOf(const Points& from, const Points& to, const std::vector<double>& weights)
{
  const glm::dmat3 rotation = nearestRotation(from, to, weights);
  const glm::dvec3 middle = weightedMean(from, weights);
  const glm::dvec3 other = weightedMean(to, weights);
  double squares = 0.0;
  double all = 0.0;
  for (std::size_t i = 0; i < from.size(); ++i)
  {
    const glm::dvec3 left = rotation * (from[i] - middle) - (to[i] - other);
    squares += weights[i] * glm::dot(left, left);
    all += weights[i];
  }
  return { glm::length(vectorFrom(rotation)), std::sqrt(squares / all) };
}

// The axes of a signed permutation: its row i has the sign at column order[i].
struct Axes
{
  int order[3];
  int signs;

  glm::dvec3 of(const glm::dvec3& point) const
  {
    glm::dvec3 result;
    for (int i = 0; i < 3; ++i)
    {
      result[i] = (this->signs >> i & 1 ? -1.0 : 1.0) * point[this->order[i]];
    }
    return result;
  }

  std::string text() const
  {
    std::string words;
    for (int i = 0; i < 3; ++i)
    {
      words +=
        std::string(i > 0 ? " " : "") + (this->signs >> i & 1 ? "-" : "") + "xyz"[this->order[i]];
    }
    return words;
  }

  int changes() const
  {
    int count = 0;
    for (int i = 0; i < 3; ++i)
    {
      count += (this->signs >> i & 1) + (this->order[i] != i ? 1 : 0);
    }
    return count;
  }
};

std::vector<Axes> allAxes()
{
  std::vector<Axes> all;
  for (const auto& order : { Axes{ { 0, 1, 2 }, 0 }, Axes{ { 0, 2, 1 }, 0 }, Axes{ { 1, 0, 2 }, 0 },
         Axes{ { 1, 2, 0 }, 0 }, Axes{ { 2, 0, 1 }, 0 }, Axes{ { 2, 1, 0 }, 0 } })
  {
    for (int signs = 0; signs < 8; ++signs)
    {
      all.push_back(order);
      all.back().signs = signs;
    }
  }
  return all;
}

// Pairs that are switched on.
struct Pairs
{
  Points rest;
  Points measured;
  std::vector<double> weights;
  std::vector<std::string> names;
};

void addOpen(const OpenRotation& open, const Pairs& pairs, Sentences& sentences)
{
  if (open.isAboutAll())
  {
    sentences.emplace_back(
      "The landmarks are at one place, or too near to each other, so no rotation is determined; "
      "away from them the position is unknown");
  }
  else if (open.isAboutLine())
  {
    const glm::dvec3& axis = open.axes[0];
    sentences.push_back("The landmarks lie within " +
      rounded(spreadAroundLine(pairs.rest, pairs.weights)) + " mm (RMS) of a line along " +
      rounded(axis.x) + " " + rounded(axis.y) + " " + rounded(axis.z) +
      ", so the rotation about it is not determined; add one that is beside it");
  }
}

void addRepeated(const Pairs& pairs, Sentences& sentences)
{
  for (std::size_t i = 0; i < pairs.rest.size(); ++i)
  {
    for (std::size_t j = 0; j < i; ++j)
    {
      if (glm::distance(pairs.rest[i], pairs.rest[j]) <= SamePlaceMm)
      {
        sentences.push_back("Landmarks " + pairs.names[j] + " and " + pairs.names[i] +
          " are at the same place at rest, measured " +
          rounded(glm::distance(pairs.measured[i], pairs.measured[j])) + " mm apart");
        return; // one shows what to look for
      }
    }
  }
}

void addUnits(const Pairs& pairs, double volumeMm, Sentences& sentences)
{
  const double extents[2] = { extentOf(pairs.rest), extentOf(pairs.measured) };
  const char* const lists[2] = { "The landmarks at rest are within ",
    "The measured landmarks are within " };
  for (int i = 0; i < 2; ++i)
  {
    const std::string which = lists[i];
    const bool isFar = volumeMm > 0.0 &&
      (extents[i] > FarthestRatio * volumeMm || extents[i] * FarthestRatio < volumeMm);
    if (pairs.rest.size() > 1 && extents[i] <= ClosestMm)
    {
      sentences.push_back(which + rounded(extents[i]) + " mm; check that they are in mm");
      return;
    }
    if (pairs.rest.size() > 1 && isFar)
    {
      sentences.push_back(which + rounded(extents[i]) + " mm, and the volume's diagonal has " +
        rounded(volumeMm) + " mm; check that they are in mm");
      return;
    }
  }
  const double ratio = extents[1] / std::max(extents[0], SamePlaceMm);
  if (pairs.rest.size() > 2 && (ratio > MostScale || ratio * MostScale < 1.0))
  {
    sentences.push_back("The measured landmarks are " + rounded(ratio) +
      " times as far apart as those at rest; check that both are in mm");
  }
}
}

std::string betterAxes(const Points& rest, const Points& measured,
  const std::vector<double>& weights, bool isAnyRotation)
{
  if (rest.size() < 3)
  {
    return {};
  }
  const Match now = matchOf(rest, measured, weights);
  const Axes* best = nullptr;
  const std::vector<Axes> all = allAxes();
  for (const Axes& axes : all)
  {
    Points other(measured.size());
    std::transform(measured.begin(), measured.end(), other.begin(),
      [&](const glm::dvec3& point) { return axes.of(point); });
    const Match then = matchOf(rest, other, weights);
    const bool isBetter = now.rms - then.rms > ClearlyWorseMm && then.rms < 0.5 * now.rms;
    const bool isNearer = !isAnyRotation && now.angle > FarRotation && then.angle < NearRotation &&
      then.rms < now.rms + 0.5 * ClearlyWorseMm;
    const bool fits = isNearer || (isBetter && (isAnyRotation || then.angle < NearRotation));
    best = fits && (!best || axes.changes() < best->changes()) ? &axes : best;
  }
  return best ? best->text() : std::string();
}

Sentences doubtsAbout(
  const Measurements& measured, const std::vector<std::string>& names, double volumeMm)
{
  Pairs on;
  for (std::size_t i = 0; i < measured.landmarks.size(); ++i)
  {
    const PointPair& pair = measured.landmarks[i];
    if (isOn(pair))
    {
      on.rest.push_back(pair.rest);
      on.measured.push_back(pair.measured);
      on.weights.push_back(pair.weight);
      on.names.push_back(i < names.size() ? names[i] : std::to_string(i + 1));
    }
  }
  Sentences sentences;
  if (on.rest.empty())
  {
    return sentences;
  }
  const FitSettings settings;
  const OpenRotation open = openRotationOf(
    on.rest, on.weights, settings.landmarkDeviation, glm::radians(settings.rotationPriorDegrees));
  if (!bendsOnly(measured))
  {
    addOpen(open, on, sentences);
  }
  addRepeated(on, sentences);
  addUnits(on, volumeMm, sentences);
  const std::string axes =
    open.isAboutLine() ? std::string() : betterAxes(on.rest, on.measured, on.weights, false);
  if (!axes.empty())
  {
    sentences.push_back("The axes of the two lists look exchanged or mirrored: the measured "
                        "landmarks would fit with " +
      axes + " in place of x y z; check whether both lists are RAS or LPS");
  }
  return sentences;
}
}

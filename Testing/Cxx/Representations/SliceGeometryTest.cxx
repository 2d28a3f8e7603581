// SPDX-License-Identifier: BSD-3-Clause
// Proves that slices take the volume's axes by the world axes they are nearest to, reach as far as
// their box, are cut where they cross, and come from back to front for any eye; and that edges are
// named for the nearest sides of the patient, with the angle to them.
#include "Representations/Slices/SliceGeometry.h"
#include "Representations/Slices/OrientationMarks.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <set>
#include <vector>

using namespace brainshift;

namespace
{
double areaOf(const std::vector<SliceQuad>& quads)
{
  double area = 0.0;
  for (const SliceQuad& quad : quads)
  {
    area += glm::length(glm::cross(quad.right, quad.up));
  }
  return area;
}

int axisAcross(const SliceQuad& quad)
{
  const glm::dvec3 normal = glm::abs(glm::cross(quad.right, quad.up));
  return normal.x > 0.0 ? 0 : normal.y > 0.0 ? 1 : 2;
}

// Share of the ray where it meets the quad; not a number where it does not.
double shareAt(const SliceQuad& quad, const glm::dvec3& from, const glm::dvec3& to)
{
  const int axis = axisAcross(quad);
  const double share = (quad.corner[axis] - from[axis]) / (to[axis] - from[axis]);
  const glm::dvec3 inQuad = from + share * (to - from) - quad.corner;
  for (const glm::dvec3& side : { quad.right, quad.up })
  {
    const double along = glm::dot(inQuad, side) / glm::dot(side, side);
    if (!(along > 0.0 && along < 1.0))
    {
      return std::numeric_limits<double>::quiet_NaN();
    }
  }
  return share;
}

void expectBackToFront(const glm::dmat4& clipFromTexture, const SlicePlanes& planes)
{
  const std::vector<SliceQuad> quads = quadsBackToFront(planes, clipFromTexture);
  const glm::dmat4 textureFromClip = glm::inverse(clipFromTexture);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  int crossings = 0;
  for (int ray = 0; ray < 500; ++ray)
  {
    const glm::dvec2 ndc(place(random), place(random));
    const glm::dvec4 near = textureFromClip * glm::dvec4(ndc, -1.0, 1.0);
    const glm::dvec4 far = textureFromClip * glm::dvec4(ndc, 1.0, 1.0);
    double before = std::numeric_limits<double>::infinity();
    for (const SliceQuad& quad : quads)
    {
      const double share = shareAt(quad, glm::dvec3(near) / near.w, glm::dvec3(far) / far.w);
      if (std::isnan(share))
      {
        continue;
      }
      EXPECT_LT(share, before) << "a quad is drawn over a nearer one";
      crossings += std::isfinite(before) ? 1 : 0;
      before = share;
    }
  }
  EXPECT_GT(crossings, 10) << "the eye must see planes behind each other";
}
}

TEST(SliceGeometry, PlanesLieAcrossTheNearestAxes)
{
  EXPECT_EQ(axesAcrossPlanes(glm::dmat3(1.0)), glm::ivec3(0, 1, 2));
  // Columns: the volume's axes in the world. Here x runs along -z, y along x, z along -y.
  const glm::dmat3 permuted({ 0, 0, -1 }, { 1, 0, 0 }, { 0, -1, 0 });
  EXPECT_EQ(axesAcrossPlanes(permuted), glm::ivec3(1, 2, 0));
  const glm::dmat3 tilted(
    glm::rotate(glm::dmat4(1.0), 0.4, glm::normalize(glm::dvec3(1.0, -2.0, 0.5))));
  EXPECT_EQ(axesAcrossPlanes(tilted * permuted), glm::ivec3(1, 2, 0));
}

TEST(SliceGeometry, WholePlanesFillTheBox)
{
  SlicePlanes planes;
  planes.low = { -0.5, 0.0, 0.1 };
  planes.high = { 1.5, 1.0, 0.9 };
  planes.position = { 1.2, 0.5, 0.3 };
  const std::vector<SliceQuad> quads = wholeQuads(planes);
  ASSERT_EQ(quads.size(), 3u);
  EXPECT_NEAR(areaOf(quads), 1.0 * 0.8 + 2.0 * 0.8 + 2.0 * 1.0, 1e-12);
  for (const SliceQuad& quad : quads)
  {
    EXPECT_EQ(quad.corner[axisAcross(quad)], planes.position[axisAcross(quad)]);
  }
}

TEST(SliceGeometry, HiddenPlanesAndPlanesBeyondTheBoxAreNotDrawn)
{
  SlicePlanes planes;
  planes.shown = { false, true, true };
  planes.position = { 0.5, 1.001, 1.0 };
  ASSERT_EQ(wholeQuads(planes).size(), 1u) << "the face of the box still belongs to it";
  EXPECT_EQ(axisAcross(wholeQuads(planes)[0]), 2);
  EXPECT_EQ(quadsBackToFront(planes, glm::dmat4(1.0)).size(), 1u);
}

TEST(SliceGeometry, CuttingLosesNothing)
{
  SlicePlanes planes;
  planes.position = { 0.2, 0.7, 0.4 };
  const std::vector<SliceQuad> parts = quadsBackToFront(planes, glm::dmat4(1.0));
  EXPECT_EQ(parts.size(), 1u + 2u + 4u);
  EXPECT_NEAR(areaOf(parts), areaOf(wholeQuads(planes)), 1e-12);
}

TEST(SliceGeometry, PartsComeFromBackToFront)
{
  SlicePlanes planes;
  planes.position = { 0.4, 0.6, 0.45 };
  for (const glm::dvec3& eye : { glm::dvec3(3, 2, 4), glm::dvec3(-2, 3, 1), glm::dvec3(1, -3, -2),
         glm::dvec3(1.5, 0.2, 2.0), glm::dvec3(-2, -2, -2) })
  {
    const glm::dmat4 view = glm::lookAt(eye, glm::dvec3(0.5), glm::dvec3(0.1, 1.0, 0.2));
    expectBackToFront(glm::perspective(0.6, 1.0, 0.1, 20.0) * view, planes);
    expectBackToFront(glm::ortho(-1.0, 1.0, -1.0, 1.0, 0.1, 20.0) * view, planes);
  }
}

TEST(OrientationMarks, TellWhereEdgesLie)
{
  const double left[3] = { -1, 0, 0 };
  const double superior[3] = { 0, 0.05, 0.99875 };
  const double oblique[3] = { 0.7, 0, 0.7 };
  const std::array<std::string, 4> expected{ "L", "R", "S", "I" };
  EXPECT_EQ(edgeLetters(left, superior, WorldAxes::RAS, false), expected);
  const std::array<std::string, 4> none;
  for (const WorldAxes axes : { WorldAxes::RAS, WorldAxes::LPS, WorldAxes::Unknown })
  {
    EXPECT_EQ(edgeLetters(left, oblique, axes, false), none);
    EXPECT_EQ(edgeLetters(oblique, superior, axes, false), none);
  }
}

TEST(OrientationMarks, TellTheAngleToTheSide)
{
  const double across[3] = { 0.978148, 0.207912, 0 }; // 12 degrees from x
  const double up[3] = { -0.207912, 0.978148, 0 };
  const std::array<std::string, 4> twelve{ "R 12\u00b0", "L 12\u00b0", "A 12\u00b0", "P 12\u00b0" };
  EXPECT_EQ(edgeLetters(across, up, WorldAxes::RAS, false), twelve);
  // Each side once, at any angle, where the view looks along an axis of the grid.
  const double half = std::sqrt(0.5);
  const double diagonal[3] = { half, half, 0 };
  const double other[3] = { -half, half, 0 };
  const auto letters = edgeLetters(diagonal, other, WorldAxes::LPS, true);
  EXPECT_EQ(letters[0].substr(1), " 45\u00b0") << letters[0];
  EXPECT_EQ(letters[2].substr(1), " 45\u00b0") << letters[2];
  EXPECT_EQ(
    std::set<char>({ letters[0][0], letters[1][0], letters[2][0], letters[3][0] }).size(), 4u);
  const std::array<std::string, 4> none;
  EXPECT_EQ(edgeLetters(diagonal, other, WorldAxes::LPS, false), none);
}

TEST(OrientationMarks, NameNoSideThatIsNotKnown)
{
  const double x[3] = { 1, 0, 0 };
  const double y[3] = { 0, 1, 0 };
  const std::array<std::string, 4> lps{ "L", "R", "P", "A" };
  EXPECT_EQ(edgeLetters(x, y, WorldAxes::LPS, false), lps);
  const std::array<std::string, 4> unknown{ "+x", "-x", "+y", "-y" };
  EXPECT_EQ(edgeLetters(x, y, WorldAxes::Unknown, false), unknown);
}

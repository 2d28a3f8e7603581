// SPDX-License-Identifier: BSD-3-Clause
// Proves that the parts of ranks fill the space once, and that a rank has all voxels whose tissue
// can come into its part, for both kernels, oblique axes, a mask and strokes at the border.
#include "Representations/Window/RankParts.h"

#include "Filters/Deformation/Lattice.h"
#include "Filters/Deformation/PointMap.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <map>
#include <random>

using namespace brainshift;

namespace
{
double sizeOf(const Box& box)
{
  return (box[1] - box[0]) * (box[3] - box[2]) * (box[5] - box[4]);
}

bool isIn(const Box& box, const glm::dvec3& place)
{
  return box[0] <= place.x && place.x < box[1] && box[2] <= place.y && place.y < box[3] &&
    box[4] <= place.z && place.z < box[5];
}

// An oblique volume of 60 x 50 x 40 points whose extent begins at 5, -3, 2.
WholeVolume obliqueVolume()
{
  WholeVolume volume;
  volume.extent = { 5, 64, -3, 46, 2, 41 };
  volume.grid.dimensions = { 60, 50, 40 };
  volume.grid.spacing = { 1.0, 1.5, 2.0 };
  volume.grid.origin = { -30.0, 20.0, 7.0 };
  volume.grid.direction =
    glm::dmat3(glm::rotate(glm::dmat4(1.0), 0.4, glm::normalize(glm::dvec3(1, 2, 3))));
  return volume;
}

// A lattice over the volume, with random displacements of up to `most` mm.
Lattice latticeOver(const WholeVolume& volume, int kernel, double most)
{
  Grid grid = volume.grid;
  grid.dimensions = { 9, 8, 7 };
  grid.spacing =
    volume.grid.spacing * glm::dvec3(volume.grid.dimensions - 1) / glm::dvec3(grid.dimensions - 1);
  Lattice lattice = makeLattice(grid, kernel);
  std::mt19937 random(7);
  std::uniform_real_distribution<float> length(-1.0f, 1.0f);
  for (auto& displacement : lattice.displacements)
  {
    displacement = float(most) * glm::vec3(length(random), length(random), length(random));
  }
  return lattice;
}

Box boundsOf(const WholeVolume& volume, double more)
{
  Box box{ 1e9, -1e9, 1e9, -1e9, 1e9, -1e9 };
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::dvec3 side(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
    const glm::dvec3 world =
      volume.grid.worldFromGrid(side * glm::dvec3(volume.grid.dimensions - 1));
    for (int axis = 0; axis < 3; ++axis)
    {
      box[2 * axis] = std::min(box[2 * axis], world[axis] - more);
      box[2 * axis + 1] = std::max(box[2 * axis + 1], world[axis] + more);
    }
  }
  return box;
}
}

TEST(RankParts, FillTheSpaceOnce)
{
  const Box whole{ -10, 30, 5, 25, 0, 90 };
  std::mt19937 random(3);
  for (const int ranks : { 1, 2, 3, 4, 7, 8 })
  {
    const std::vector<Box> parts = rankParts(whole, ranks);
    ASSERT_EQ(int(parts.size()), ranks);
    double size = 0.0;
    for (const Box& part : parts)
    {
      EXPECT_NEAR(sizeOf(part), sizeOf(whole) / ranks, 1e-6) << ranks;
      size += sizeOf(part);
    }
    EXPECT_NEAR(size, sizeOf(whole), 1e-6);
    for (int i = 0; i < 1000; ++i)
    {
      const glm::dvec3 place(std::uniform_real_distribution<>(-10, 30)(random),
        std::uniform_real_distribution<>(5, 25)(random),
        std::uniform_real_distribution<>(0, 90)(random));
      int owners = 0;
      for (const Box& part : parts)
      {
        owners += isIn(part, place);
      }
      EXPECT_EQ(owners, 1) << ranks;
    }
  }
}

// Visible tissue in a corner: an eighth of each side, as an ultrasound sweep in a large volume.
TEST(RankParts, AreBalancedByWhatIsVisible)
{
  TissueCounts counts;
  counts.box = { -10, 30, 5, 25, 0, 90 };
  std::mt19937 random(9);
  std::uniform_real_distribution<> fraction(0.0, 0.125);
  for (int i = 0; i < 20000; ++i)
  {
    counts.add(
      { -10 + 40 * fraction(random), 5 + 20 * fraction(random), 90 * fraction(random) }, 1);
  }
  const auto most = [&](const std::vector<Box>& parts) {
    double work = 0.0;
    for (const Box& part : parts)
    {
      work = std::max(work, counts.workIn(part));
    }
    return work * static_cast<double>(parts.size());
  };
  EXPECT_EQ(balancedParts({}, {}, 2, counts), rankParts(counts.box, 2)) << "one would hold all";
  for (const int ranks : { 3, 4, 8 })
  {
    const std::vector<Box> parts = balancedParts({}, {}, ranks, counts);
    EXPECT_GT(most(rankParts(counts.box, ranks)), 1.9) << ranks; // of the mean
    EXPECT_LT(most(parts), 1.01) << ranks;
    double size = 0.0;
    for (const Box& part : parts)
    {
      size += sizeOf(part);
      EXPECT_LE(sizeOf(part), 2.001 / ranks * sizeOf(counts.box));
    }
    EXPECT_NEAR(size, sizeOf(counts.box), 1e-6);
    EXPECT_EQ(balancedParts(parts, counts.box, ranks, counts), parts) << "nothing moves them";
  }
}

TEST(RankParts, StayUntilTheirWorkIsFarFromTheMean)
{
  constexpr int ranks = 4;
  TissueCounts counts;
  counts.box = { 0, 64, 0, 16, 0, 16 };
  const auto fill = [&](double from, double to) {
    std::fill(counts.cells.begin(), counts.cells.end(), 0);
    for (double x = from; x < to; x += 0.25)
    {
      counts.add({ x, 8.0, 8.0 }, 1);
    }
  };
  fill(0.0, 64.0);
  const std::vector<Box> equal = balancedParts({}, {}, ranks, counts);
  EXPECT_EQ(equal, rankParts(counts.box, ranks));
  fill(0.0, 40.0); // a part has 1.3 times the mean
  EXPECT_EQ(balancedParts(equal, counts.box, ranks, counts), equal);
  fill(0.0, 8.0);
  EXPECT_EQ(balancedParts(equal, counts.box, ranks, counts, /*keeps*/ true), equal);
  const std::vector<Box> moved = balancedParts(equal, counts.box, ranks, counts);
  EXPECT_LT(moved[0][1], 8.0);

  // A stroke widens the box: the cuts between the parts stay.
  const Box former = counts.box;
  counts.box = { -3, 64, 0, 18, 0, 16 };
  std::vector<Box> expected = moved;
  for (Box& part : expected)
  {
    part[0] = part[0] == 0.0 ? -3.0 : part[0];
    part[3] = part[3] == 16.0 ? 18.0 : part[3];
  }
  EXPECT_EQ(balancedParts(moved, former, ranks, counts), expected);
  // Another volume: they do not fit.
  counts.box = { 100, 164, 0, 16, 0, 16 };
  EXPECT_EQ(balancedParts(moved, former, ranks, counts)[0][0], 100.0);
  EXPECT_EQ(balancedParts(moved, former, ranks, counts, /*keeps*/ true)[0][0], 100.0);
}

// Axes that point backwards turn the order of the pipeline's pieces around.
TEST(RankParts, AreThoseOfTheVoxelsThatARankHolds)
{
  const Box whole{ 0, 64, 0, 64, 0, 64 };
  const std::vector<Box> parts = rankParts(whole, 8);
  std::vector<Box> held(parts.rbegin(), parts.rend());
  EXPECT_EQ(nearestParts(parts, held), held);
  EXPECT_EQ(nearestParts(held, held), held) << "they stay";
  held[2] = { 1e300, -1e300, 1e300, -1e300, 1e300, -1e300 }; // no voxels
  EXPECT_EQ(nearestParts(parts, held)[2], parts[5]) << "the one that is left";
  std::fill(held.begin(), held.end(), whole); // as if each read all
  EXPECT_EQ(nearestParts(parts, held), parts);

  std::mt19937 random(12);
  std::uniform_real_distribution<> place(0.0, 64.0);
  for (int i = 0; i < 100; ++i)
  {
    for (Box& box : held)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        const double a = std::floor(place(random) / 16.0);
        box[2 * axis] = 16.0 * a;
        box[2 * axis + 1] = 16.0 * a + 32.0;
      }
    }
    const std::vector<Box> nearest = nearestParts(parts, held);
    EXPECT_TRUE(std::is_permutation(nearest.begin(), nearest.end(), parts.begin()));
    EXPECT_EQ(nearestParts(nearest, held), nearest) << "they stay";
  }
}

TEST(RankParts, HaveAllTissueThatComesIntoThem)
{
  const WholeVolume volume = obliqueVolume();
  for (const int kernel : { 0, 1 })
  {
    for (const double most : { 0.0, 3.0, 12.0 })
    {
      const Lattice lattice = latticeOver(volume, kernel, most);
      const std::vector<Box> parts = rankParts(boundsOf(volume, 2.0 * most + 1.0), 4);
      std::mt19937 random(5);
      std::uniform_real_distribution<> fraction(0.0, 1.0);
      for (int i = 0; i < 4000; ++i)
      {
        const glm::dvec3 voxel =
          glm::floor(glm::dvec3(fraction(random), fraction(random), fraction(random)) *
            glm::dvec3(volume.grid.dimensions));
        const glm::dvec3 rest = volume.grid.worldFromGrid(voxel);
        const glm::dvec3 deformed = rest + displacementOfTissue(lattice, rest);
        for (const Box& part : parts)
        {
          if (!isIn(part, deformed))
          {
            continue;
          }
          const Extent extent = restExtent(volume, &lattice, part, 0.0);
          for (int axis = 0; axis < 3; ++axis)
          {
            const double at = voxel[axis] + volume.extent[2 * axis];
            // Its neighbours are there, too, but beyond the volume.
            EXPECT_LE(extent[2 * axis], std::max(at - 2.0, double(volume.extent[2 * axis])));
            EXPECT_GE(
              extent[2 * axis + 1], std::min(at + 2.0, double(volume.extent[2 * axis + 1])));
          }
        }
      }
    }
  }
}

TEST(RankParts, NeedLittleMoreThanTheirOwn)
{
  WholeVolume volume = obliqueVolume();
  volume.grid.direction = glm::dmat3(1.0);
  const Box part{ -30.0, -10.0, 20.0, 50.0, 7.0, 27.0 };
  const Extent still = restExtent(volume, nullptr, part, 0.0);
  EXPECT_EQ(still, (Extent{ 5, 28, -3, 20, 2, 15 }));
  EXPECT_EQ(restExtent(volume, nullptr, part, 4.0), (Extent{ 5, 32, -3, 23, 2, 17 }));

  // A stroke far away asks for no voxel.
  Lattice lattice = latticeOver(volume, 1, 0.0);
  lattice.displacements[lattice.grid.offset(8, 7, 6)] = glm::vec3(-3.0f, 0.0f, 0.0f);
  EXPECT_EQ(restExtent(volume, &lattice, part, 0.0), still);
  lattice.displacements[lattice.grid.offset(2, 2, 2)] = glm::vec3(-3.0f, 0.0f, 0.0f);
  EXPECT_EQ(restExtent(volume, &lattice, part, 0.0), (Extent{ 5, 31, -3, 20, 2, 15 }));
}

// The figures of Documentation/servers.md: 512 points of 0.5 mm a side, a halo of 10 mm.
TEST(RankParts, HoldTheirFractionAndAHalo)
{
  WholeVolume volume;
  volume.extent = { 0, 511, 0, 511, 0, 511 };
  volume.grid.dimensions = glm::ivec3(512);
  volume.grid.spacing = glm::dvec3(0.5);
  const std::map<int, double> most{ { 1, 1.0 }, { 2, 0.55 }, { 4, 0.30 }, { 8, 0.17 },
    { 64, 0.041 } };
  for (const auto& [ranks, fraction] : most)
  {
    double largest = 0.0;
    for (const Box& part : rankParts(boundsOf(volume, 0.0), ranks))
    {
      const Extent extent = restExtent(volume, nullptr, part, 10.0);
      double points = 1.0;
      for (int axis = 0; axis < 3; ++axis)
      {
        points *= extent[2 * axis + 1] - extent[2 * axis] + 1;
      }
      largest = std::max(largest, points / std::pow(512.0, 3.0));
    }
    std::cout << ranks << " ranks: the largest holds " << largest << "\n";
    EXPECT_LE(largest, fraction) << ranks;
    EXPECT_GE(largest, 1.0 / ranks) << ranks;
  }
}

TEST(RankParts, BeyondTheVolumeHaveItsNearestVoxels)
{
  const WholeVolume volume = obliqueVolume();
  const Box far{ 1000, 1010, 1000, 1010, 1000, 1010 };
  const Extent extent = restExtent(volume, nullptr, far, 0.0);
  EXPECT_TRUE(holds(volume.extent, extent));
  for (int axis = 0; axis < 3; ++axis)
  {
    EXPECT_EQ(extent[2 * axis + 1] - extent[2 * axis], 1);
  }
  EXPECT_FALSE(holds(extent, volume.extent));
}

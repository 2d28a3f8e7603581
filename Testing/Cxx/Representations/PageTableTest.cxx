// SPDX-License-Identifier: BSD-3-Clause
// Proves that each brick of a finer level is found in the slot that was given to it, that a view
// loses none of its own bricks, that the ranges of a brick hold all that interpolation can find in
// the rest bricks that it covers, and which level suits a view.
#include "Representations/Bricks/StreamedBricks.h"

#include "vtkMatrix4x4.h"
#include "vtkNew.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using namespace brainshift;

namespace
{
// What the shader finds: the slot of a brick by its texel.
int slotByTexel(const PageTable& table, int brick)
{
  const std::uint8_t* texel = &table.texels()[4 * static_cast<std::size_t>(brick)];
  const glm::ivec3& side = table.slots();
  return texel[3] == 0 ? PageTable::None : (texel[2] * side.y + texel[1]) * side.x + texel[0];
}
}

TEST(PageTable, LeadsToTheSlotOfEachBrick)
{
  PageTable table;
  table.reset({ 5, 4, 3 }, { 3, 2, 2 });
  EXPECT_EQ(table.capacity(), 12);
  std::mt19937 random(41);
  std::vector<int> content(12, PageTable::None); // brick of each slot
  for (int view = 1; view <= 200; ++view)
  {
    for (int i = 0; i < 6; ++i)
    {
      const int brick = static_cast<int>(random() % 60);
      if (table.slotOf(brick) != PageTable::None)
      {
        table.use(brick, view);
        continue;
      }
      const int slot = table.take(brick, view);
      ASSERT_NE(slot, PageTable::None);
      content[slot] = brick;
    }
    std::vector<int> found(12, PageTable::None);
    for (int brick = 0; brick < 60; ++brick)
    {
      const int slot = slotByTexel(table, brick);
      ASSERT_EQ(slot, table.slotOf(brick));
      if (slot != PageTable::None)
      {
        found[slot] = brick;
        const glm::ivec3 place = table.positionOf(slot);
        ASSERT_EQ((place.z * 2 + place.y) * 3 + place.x, slot);
      }
    }
    ASSERT_EQ(found, content) << "view " << view;
  }
}

TEST(PageTable, NamesTheLayersThatChanged)
{
  PageTable table;
  table.reset({ 5, 4, 6 }, { 3, 2, 2 });
  EXPECT_EQ(table.takeChangedLayers(), glm::ivec2(0, 6));
  std::mt19937 random(43);
  std::vector<std::uint8_t> sent = table.texels();
  for (int view = 1; view <= 100; ++view)
  {
    for (int i = 0; i < 2; ++i)
    {
      const int brick = static_cast<int>(random() % 120);
      if (table.slotOf(brick) == PageTable::None)
      {
        table.take(brick, view);
      }
    }
    const glm::ivec2 layers = table.takeChangedLayers();
    std::copy(table.texels().begin() + 80 * layers.x, table.texels().begin() + 80 * layers.y,
      sent.begin() + 80 * layers.x);
    ASSERT_EQ(sent, table.texels()) << "view " << view;
  }
  EXPECT_EQ(table.takeChangedLayers(), glm::ivec2(0)) << "nothing since";
}

TEST(PageTable, TakesFromBricksThatWereNotSeenForLongest)
{
  PageTable table;
  table.reset({ 8, 1, 1 }, { 3, 1, 1 });
  table.take(0, 1);
  table.take(1, 1);
  EXPECT_EQ(table.room(1), 1);
  table.take(2, 2);
  table.use(0, 3);
  EXPECT_EQ(table.room(3), 2);
  table.take(3, 3);
  EXPECT_EQ(table.slotOf(1), PageTable::None);
  table.take(4, 3);
  EXPECT_EQ(table.slotOf(2), PageTable::None);
  EXPECT_NE(table.slotOf(0), PageTable::None);
  EXPECT_EQ(table.take(5, 3), PageTable::None) << "the view keeps what it has";
  EXPECT_EQ(table.take(5, 2), PageTable::None) << "what an earlier view asked for takes nothing";
  EXPECT_EQ(table.room(3), 0);
  EXPECT_EQ(table.count(), 3);
}

namespace
{
// A level twice as fine as 40 x 32 x 24 texels, half a voxel of it shifted.
BrickOrder twiceAsFine()
{
  BrickOrder order;
  order.texels = { 40, 32, 24 };
  order.fine.voxels = { 80, 64, 48 };
  order.fine.voxelFromTexture = { 80.0, 64.0, 48.0 };
  order.fine.voxelOfTextureZero = { 0.5, 0.0, -0.25 };
  return order;
}
}

TEST(CoveredRanges, HoldAllThatInterpolationFinds)
{
  const BrickOrder order = twiceAsFine();
  const glm::ivec3 brick(1, 0, 1);
  std::mt19937 random(7);
  StoredNumbers numbers;
  for (int i = 0; i < SlotSideVoxels * SlotSideVoxels * SlotSideVoxels; ++i)
  {
    numbers.floats.push_back(static_cast<float>(random() % 1000));
  }
  numbers.floats[1234] = std::numeric_limits<float>::quiet_NaN();
  const CoveredRanges covered = coveredRanges(numbers, brick, order);
  const glm::ivec3& count = covered.found.count;
  const auto at = [&](const glm::ivec3& voxel) {
    return numbers.floats[(voxel.z * SlotSideVoxels + voxel.y) * SlotSideVoxels + voxel.x];
  };
  std::uniform_real_distribution<double> within(0.0, StreamedSide);
  for (int i = 0; i < 200000; ++i)
  {
    const glm::dvec3 inBrick(within(random), within(random), within(random));
    const glm::dvec3 inSlot = inBrick + double(SlotBorder) - 0.5; // from the middle of a voxel
    const glm::ivec3 low(glm::floor(inSlot));
    const glm::dvec3 way = inSlot - glm::dvec3(low);
    double value = 0.0;
    for (int corner = 0; corner < 8; ++corner)
    {
      const glm::ivec3 side(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
      const glm::dvec3 weight = glm::mix(1.0 - way, way, glm::dvec3(side));
      value += weight.x * weight.y * weight.z * at(low + side);
    }
    if (std::isnan(value))
    {
      continue;
    }
    const glm::dvec3 fine = inBrick + glm::dvec3(brick * StreamedSide);
    const glm::dvec3 voxel = (fine - order.fine.voxelOfTextureZero) / order.fine.voxelFromTexture *
        glm::dvec3(order.texels) -
      0.5;
    const glm::ivec3 bricks = (order.texels + RestBrickSide - 1) / RestBrickSide;
    const glm::ivec3 rest =
      glm::clamp(glm::ivec3(glm::floor(voxel / double(RestBrickSide))), glm::ivec3(0), bricks - 1) -
      covered.first;
    ASSERT_TRUE(glm::all(glm::greaterThanEqual(rest, glm::ivec3(0))));
    ASSERT_TRUE(glm::all(glm::lessThan(rest, count)));
    const glm::vec2& range = covered.found.ranges[(rest.z * count.y + rest.y) * count.x + rest.x];
    ASSERT_LE(range.x, value + 1e-3);
    ASSERT_GE(range.y, value - 1e-3);
  }
}

namespace
{
// 64 voxels of 2 mm a side, which begin at -0.5 mm.
DrawnValues valuesOfLevel()
{
  DrawnValues values;
  values.grid.dimensions = glm::ivec3(64);
  values.grid.spacing = glm::dvec3(2.0);
  values.grid.origin = glm::dvec3(0.5);
  values.layout = layoutOf(values.grid.dimensions, false);
  return values;
}

// Of 0.5 and 1 mm. `acrossMm`: how far apart the slices of the two are.
std::vector<Grid> finerGrids(glm::dvec2 acrossMm)
{
  std::vector<Grid> finer(2);
  finer[0].dimensions = glm::ivec3(256);
  finer[0].spacing = glm::dvec3(0.5);
  finer[0].origin = glm::dvec3(-0.25);
  finer[1].dimensions = glm::ivec3(128);
  finer[1].spacing = glm::dvec3(1.0);
  for (int i = 0; i < 2; ++i)
  {
    finer[i].dimensions.z = static_cast<int>(128.0 / acrossMm[i]);
    finer[i].spacing.z = acrossMm[i];
    finer[i].origin.z = 0.5 * acrossMm[i] - 0.5;
  }
  return finer;
}

BrickView viewOf(const DrawnValues& values, const glm::dmat4& clipFromEye, const glm::dvec3& eye)
{
  BrickView view;
  view.pixels = glm::ivec2(100);
  const vtkNew<vtkMatrix4x4> unmoved;
  view.frame.worldFromTexture = worldFromTexture(values.grid, values.layout, unmoved);
  view.frame.clipFromWorld = clipFromEye * glm::translate(glm::dmat4(1.0), -eye);
  return view;
}

// On slices seen in parallel: 100 pixels show twice `half` mm.
std::optional<FineGrid> levelSeen(
  double half, glm::dvec2 acrossMm = { 0.5, 1.0 }, bool ofSlices = true)
{
  const DrawnValues values = valuesOfLevel();
  const glm::dmat4 clipFromEye = glm::ortho(-half, half, -half, half, 1.0, 500.0);
  BrickView view = viewOf(values, clipFromEye, { 64.0, 64.0, 300.0 });
  view.ofSlices = ofSlices;
  return levelFor(values, finerGrids(acrossMm), view);
}
}

TEST(LevelFor, HasVoxelsNoLongerThanAPixel)
{
  FineGrid none;
  none.level = 99;
  EXPECT_FALSE(levelSeen(150.0)); // pixels of 3 mm
  EXPECT_EQ(levelSeen(90.0).value_or(none).level, 1U);
  EXPECT_EQ(levelSeen(40.0).value_or(none).level, 0U);
  EXPECT_EQ(levelSeen(2.0).value_or(none).level, 0U); // none is as fine
  const FineGrid fine = levelSeen(90.0).value_or(none);
  EXPECT_EQ(fine.voxels, glm::ivec3(128));
  EXPECT_NEAR(fine.voxelFromTexture.x, 128.0, 1e-9);
  // The volume's texture begins at -0.5 mm, the level's first voxel, at 0 mm, does, too.
  EXPECT_NEAR(fine.voxelOfTextureZero.x, 0.0, 1e-9);
}

TEST(LevelFor, HasVoxelsOfUpTo1Point41PixelsForRays)
{
  FineGrid none;
  none.level = 99;
  const auto seen = [](double half) { return levelSeen(half, { 0.5, 1.0 }, false); };
  EXPECT_FALSE(seen(71.0)); // pixels of 1.42 mm; the volume's voxels have 2 mm
  EXPECT_EQ(seen(70.0).value_or(none).level, 1U);
  EXPECT_EQ(seen(35.5).value_or(none).level, 1U);
  EXPECT_EQ(seen(35.0).value_or(none).level, 0U);
}

TEST(LevelFor, TakesOneThatIsFinerWithinSlicesAlone)
{
  FineGrid none;
  none.level = 99;
  // Slices of 1 mm in both levels, which are as near to each other as pixels ask for, or not.
  EXPECT_EQ(levelSeen(90.0, { 1.0, 1.0 }).value_or(none).level, 1U);
  EXPECT_EQ(levelSeen(40.0, { 1.0, 1.0 }).value_or(none).level, 0U);
  EXPECT_EQ(levelSeen(2.0, { 1.0, 1.0 }).value_or(none).level, 0U);
  // Slices as far apart as in what is held.
  EXPECT_EQ(levelSeen(90.0, { 2.0, 2.0 }).value_or(none).level, 1U);
  EXPECT_EQ(levelSeen(40.0, { 2.0, 2.0 }).value_or(none).level, 0U);
  EXPECT_FALSE(levelSeen(150.0, { 2.0, 2.0 }));
}

TEST(LevelFor, CountsPixelsWhereSlicesAreNearest)
{
  const DrawnValues values = valuesOfLevel();
  // 100 pixels show 180 mm at a distance of 180 mm; the volume begins 60 mm from the eye.
  const double angle = 2.0 * std::atan(0.5);
  BrickView view = viewOf(values, glm::perspective(angle, 1.0, 1.0, 500.0), { 64.0, 64.0, 187.5 });
  view.ofSlices = true;
  const std::vector<Grid> finer = finerGrids({ 0.5, 1.0 });
  FineGrid none;
  none.level = 99;
  EXPECT_EQ(levelFor(values, finer, view).value_or(none).level, 0U); // pixels of 0.6 mm
  for (const double z : { 0.0, 1.0 })
  {
    view.corners = { { 0.0, 0.0, z }, { 1.0, 0.0, z }, { 0.0, 1.0, z }, { 1.0, 1.0, z } };
    EXPECT_EQ(levelFor(values, finer, view).value_or(none).level, z == 0.0 ? 1U : 0U);
  }
}

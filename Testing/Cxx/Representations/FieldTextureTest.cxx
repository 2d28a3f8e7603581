// SPDX-License-Identifier: BSD-3-Clause
// Proves that the GPU computes the same fields as the CPU: what is drawn is what is baked.
#include "Representations/Field/FieldTexture.h"
#include "Filters/Deformation/Kernels.h"
#include "Filters/Deformation/MaskWeights.h"
#include "Testing/Cxx/Deformation/TestLattices.h"
#include "Testing/Cxx/Representations/TestFieldRequest.h"
#include "Testing/Cxx/Representations/TestWindow.h"

#include <vtkPixelBufferObject.h>
#include <vtkSmartPointer.h>
#include <vtkTextureObject.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
// What a texture of ours holds, without its fourth component.
std::vector<glm::vec3> download(vtkTextureObject* texture)
{
  auto buffer = vtkSmartPointer<vtkPixelBufferObject>::Take(texture->Download());
  const unsigned int size[3] = { texture->GetWidth(), texture->GetHeight(), texture->GetDepth() };
  unsigned int dimensions[3] = { size[0], size[1] * size[2], 1 };
  std::vector<float> texels(4 * std::size_t(size[0]) * size[1] * size[2]);
  vtkIdType increments[2] = { 0, 0 };
  EXPECT_TRUE(buffer->Download2D(VTK_FLOAT, texels.data(), dimensions, 4, increments));
  std::vector<glm::vec3> values;
  for (std::size_t i = 0; i < texels.size(); i += 4)
  {
    values.emplace_back(texels[i], texels[i + 1], texels[i + 2]);
  }
  return values;
}

// Displacements on all nodes of the lattice: zero where the field holds none.
std::vector<glm::vec3> displacementsOf(const FieldTexture& field, const FieldNodes& nodes)
{
  std::vector<glm::vec3> all(std::size_t(nodes.count.x) * nodes.count.y * nodes.count.z);
  if (!field.displacements())
  {
    return all;
  }
  const IndexBox box = field.heldNodes();
  std::size_t texel = 0;
  const std::vector<glm::vec3> texels = download(field.displacements());
  for (int k = box.first.z; k <= box.last.z; ++k)
  {
    for (int j = box.first.y; j <= box.last.y; ++j)
    {
      for (int i = box.first.x; i <= box.last.x; ++i, ++texel)
      {
        if (i < field.displacedNodes().first.x)
        {
          EXPECT_EQ(texels.at(texel), glm::vec3(0.0f)) << "before what moves";
        }
        else
        {
          all[(std::size_t(k) * nodes.count.y + j) * nodes.count.x + i] = texels.at(texel);
        }
      }
    }
  }
  return all;
}

float largest(const std::vector<glm::vec3>& values)
{
  float result = 0.0f;
  for (const glm::vec3& value : values)
  {
    result = std::max(result, glm::length(value));
  }
  return result;
}

float largestDifference(const std::vector<glm::vec3>& left, const std::vector<glm::vec3>& right)
{
  EXPECT_EQ(left.size(), right.size());
  float result = left.size() == right.size() ? 0.0f : 1e30f;
  for (std::size_t i = 0; i < std::min(left.size(), right.size()); ++i)
  {
    result = std::max(result, glm::distance(left[i], right[i]));
  }
  return result;
}

// Kernel, control points a side, samples.
using Case = std::tuple<int, glm::ivec3, int>;

class FieldTextureTest : public ::testing::TestWithParam<Case>
{
protected:
  FieldTextureTest()
    : Bent(randomLatticeWithoutFolds(
        obliqueGrid(std::get<1>(GetParam())), std::get<0>(GetParam()), 51))
    , Samples(std::get<2>(GetParam()))
  {
  }
  ~FieldTextureTest() override { this->Field.releaseGraphicsResources(this->Shown.window()); }

  NodeField refined() const
  {
    return refine(
      this->Bent.grid, this->Bent.kernel, displacementsInCells(this->Bent), this->Samples);
  }

  Lattice Bent;
  int Samples;
  TestWindow Shown;
  FieldTexture Field;
  Counters Count;
};
}

TEST_P(FieldTextureTest, RefinesLikeTheCPU)
{
  const FieldRequest request = requestFor(this->Bent, this->Samples, Inverse::Exact);
  ASSERT_TRUE(this->Field.update(this->Shown.window(), request, this->Count));
  const NodeField known = this->refined();
  EXPECT_LT(largestDifference(displacementsOf(this->Field, known.nodes), known.values),
    1e-5f * largest(known.values));
}

TEST_P(FieldTextureTest, InvertsLikeTheCPU)
{
  FieldRequest request = requestFor(this->Bent, this->Samples, Inverse::Exact);
  ASSERT_TRUE(this->Field.update(this->Shown.window(), request, this->Count));
  const NodeField forward = this->refined();
  const std::vector<glm::vec3> offsets = download(this->Field.offsets());
  const std::vector<glm::vec3> known = invert(forward, request.nodes, Inverse::Exact).values;
  // Both stop within 2e-5 cells of the drawn point. Where tissue is squeezed to a tenth, that is
  // up to some ten times as far at rest, so the answers may differ though both are right.
  EXPECT_LT(largestDifference(offsets, known), 1e-3f);
  std::size_t index = 0;
  float miss = 0.0f;
  for (int k = 0; k < request.nodes.count.z; ++k)
  {
    for (int j = 0; j < request.nodes.count.y; ++j)
    {
      for (int i = 0; i < request.nodes.count.x; ++i, ++index)
      {
        const glm::vec3 deformed = request.nodes.latticeFromNode(glm::vec3(i, j, k));
        const glm::vec3 rest = deformed + offsets[index];
        miss = std::max(miss, glm::distance(rest + forward.displacement(rest), deformed));
      }
    }
  }
  EXPECT_LT(miss, 3e-5f) << "lattice cells: the solver's 2e-5 and rounding";
}

TEST_P(FieldTextureTest, NegatesLikeTheCPU)
{
  FieldRequest request = requestFor(this->Bent, this->Samples, Inverse::Negated);
  request.offsetScale = { 0.5f, 0.25f, 2.0f };
  ASSERT_TRUE(this->Field.update(this->Shown.window(), request, this->Count));
  std::vector<glm::vec3> known = invert(this->refined(), request.nodes, Inverse::Negated).values;
  for (glm::vec3& offset : known)
  {
    offset *= request.offsetScale;
  }
  EXPECT_LT(largestDifference(download(this->Field.offsets()), known), 1e-5f * largest(known));
}

TEST_P(FieldTextureTest, MasksLikeTheCPU)
{
  // A ball's weights, then others, then none, on the same control points.
  const glm::dvec3 middle =
    this->Bent.grid.worldFromGrid(glm::dvec3(this->Bent.grid.dimensions) / 2.0);
  for (const double radius : { 25.0, 18.0, 0.0 })
  {
    if (radius > 0.0)
    {
      Mask mask{ plainGrid(glm::ivec3(61), glm::dvec3(1.0)), {} };
      mask.grid.origin = middle - 30.0;
      for (int voxel = 0; voxel < 61 * 61 * 61; ++voxel)
      {
        const glm::dvec3 at(voxel % 61 - 30, voxel / 61 % 61 - 30, voxel / 3721 - 30);
        mask.inside.push_back(glm::length(at) < radius);
      }
      this->Bent.mask = maskWeights(this->Bent.grid, this->Samples, mask, 9.0);
    }
    else
    {
      this->Bent.mask = nullptr;
    }
    const FieldRequest request = requestFor(this->Bent, this->Samples, Inverse::Exact);
    ASSERT_TRUE(this->Field.update(this->Shown.window(), request, this->Count));
    const NodeField known = refine(this->Bent, this->Samples);
    EXPECT_LT(largestDifference(displacementsOf(this->Field, known.nodes), known.values),
      1e-5f * std::max(largest(known.values), 1.0f))
      << radius;
    EXPECT_LT(largestDifference(download(this->Field.offsets()),
                invert(known, request.nodes, Inverse::Exact).values),
      1e-3f)
      << radius;
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, FieldTextureTest,
  ::testing::Values(Case{ KernelCatmullRom, { 4, 4, 4 }, 0 }, Case{ KernelBSpline, { 4, 4, 4 }, 1 },
    Case{ KernelCatmullRom, { 5, 9, 7 }, 4 }, Case{ KernelBSpline, { 9, 5, 7 }, 4 },
    Case{ KernelCatmullRom, { 6, 4, 11 }, 16 }, Case{ KernelBSpline, { 19, 19, 19 }, 4 },
    Case{ KernelCatmullRom, { 19, 19, 19 }, 4 }));

TEST(FieldTexture, FollowsItsRequest)
{
  TestWindow shown;
  FieldTexture field;
  Counters count;
  for (const glm::ivec3& dimensions : { glm::ivec3(5), glm::ivec3(4, 7, 6), glm::ivec3(5) })
  {
    const Lattice lattice = randomLatticeWithoutFolds(obliqueGrid(dimensions), 0, 52);
    const FieldRequest request = requestFor(lattice, 2, Inverse::Negated);
    ASSERT_TRUE(field.update(shown.window(), request, count));
    const NodeField known =
      invert(refine(lattice.grid, 0, request.inCells, 2), request.nodes, Inverse::Negated);
    EXPECT_LT(largestDifference(download(field.offsets()), known.values), 1e-5f);
  }
  EXPECT_EQ(count.latticeUploads, 3);
  EXPECT_EQ(count.programsCompiled, 2);
  field.releaseGraphicsResources(shown.window());
  EXPECT_EQ(field.offsets(), nullptr);
}

// Tissue that hardly moves must be inverted, too, if it is stretched threefold there.
TEST(FieldTexture, InvertsSmallDisplacementsInStretchedTissue)
{
  TestWindow shown;
  FieldTexture field;
  Counters count;
  const Grid grid = plainGrid(glm::ivec3(7), glm::dvec3(1.0));
  // A node lies 0.00012 cells beside the plane that stays: it moves by 0.00024 cells.
  const Lattice lattice = latticeOf(grid, KernelCatmullRom,
    [](const glm::dvec3& rest) { return glm::dvec3(2.0 * (rest.x - 3.00012), 0.0, 0.0); });
  const FieldRequest request = requestFor(lattice, 4, Inverse::Exact);
  ASSERT_TRUE(field.update(shown.window(), request, count));
  const NodeField forward = refine(lattice, 4);
  NodeField offsets{ request.nodes, download(field.offsets()) };
  const glm::vec3 deformed(3.0f);
  const glm::vec3 rest = deformed + offsets.displacement(deformed);
  EXPECT_LT(glm::distance(rest + forward.displacement(rest), deformed), 3e-5f);
  field.releaseGraphicsResources(shown.window());
}

// Where nothing moves textures are kept at zero, and only what moves, or moved, is made anew.
TEST(FieldTexture, MakesWhatMovesAnewForOtherSettings)
{
  TestWindow shown;
  FieldTexture field;
  Counters count;
  Lattice lattice = makeLattice(obliqueGrid(glm::ivec3(14)), KernelCatmullRom);
  const std::size_t middle = (7 * 14 + 7) * 14 + 7;
  lattice.displacements[middle] = { 3.0f, -2.0f, 1.0f };
  FieldRequest request = requestFor(lattice, 4, Inverse::Exact);
  const FieldNodes nodes = request.nodes;
  const auto check = [&](const char* what) {
    const std::int64_t before = count.texelsRefined;
    ASSERT_TRUE(field.update(shown.window(), request, count)) << what;
    const NodeField known = refine(lattice.grid, request.kernel, request.inCells, request.samples);
    const float large = largest(known.values);
    EXPECT_LT(largestDifference(displacementsOf(field, known.nodes), known.values), 1e-5f * large)
      << what;
    EXPECT_LT(largestDifference(
                download(field.offsets()), invert(known, request.nodes, request.inverse).values),
      1e-3f * large)
      << what;
    const glm::ivec3& all = request.nodes.count;
    EXPECT_LT(count.texelsRefined - before, all.x * all.y * all.z / 2) << what;
  };
  check("first");
  request.kernel = KernelBSpline;
  check("other kernel");
  request.inverse = Inverse::Negated;
  check("other inverse");
  std::swap(request.inCells[middle], request.inCells[middle + 2]);
  request.kernel = KernelCatmullRom;
  check("kernel and control points");
  request.samples = 2;
  request.nodes = backwardNodes(lattice.grid, request.inCells, 2);
  check("fewer samples");
  EXPECT_FALSE(request.nodes == nodes);
  request.inCells.assign(request.inCells.size(), glm::vec3(0.0f));
  ASSERT_TRUE(field.update(shown.window(), request, count));
  EXPECT_EQ(largest(download(field.offsets())), 0.0f);
}

// Displacements are held around what moves, wherever that goes, and are right there.
TEST(FieldTexture, HoldsDisplacementsWhereTissueMoves)
{
  TestWindow shown;
  FieldTexture field;
  Counters count;
  Lattice lattice = makeLattice(obliqueGrid(glm::ivec3(14)), KernelCatmullRom);
  const FieldRequest still = requestFor(lattice, 4, Inverse::Exact);
  const auto nodesHeld = [&](std::initializer_list<glm::ivec3> movedPoints) {
    FieldRequest request = still;
    for (const glm::ivec3& point : movedPoints)
    {
      request.inCells[(point.z * 14 + point.y) * 14 + point.x] = { 0.2f, -0.15f, 0.1f };
    }
    EXPECT_TRUE(field.update(shown.window(), request, count));
    const NodeField known = refine(lattice.grid, lattice.kernel, request.inCells, 4);
    EXPECT_LT(largestDifference(displacementsOf(field, known.nodes), known.values), 1e-6f);
    EXPECT_LT(largestDifference(
                download(field.offsets()), invert(known, request.nodes, Inverse::Exact).values),
      1e-4f);
    const glm::ivec3 held = field.displacedNodes().size();
    return held.x * held.y * held.z;
  };
  EXPECT_EQ(nodesHeld({}), 0);
  const int around = 4 * 5 + 1; // nodes a side that a control point moves
  EXPECT_EQ(nodesHeld({ { 4, 4, 4 } }), around * around * around);
  EXPECT_EQ(nodesHeld({ { 4, 4, 4 }, { 5, 4, 4 } }), (around + 5) * around * around);
  EXPECT_EQ(nodesHeld({ { 5, 4, 4 } }), (around + 5) * around * around) << "little to spare: kept";
  const int apart = around + 5 * 5;
  EXPECT_EQ(nodesHeld({ { 4, 4, 4 }, { 9, 9, 9 } }), apart * apart * apart);
  EXPECT_EQ(nodesHeld({ { 9, 9, 9 } }), around * around * around) << "much to spare: made anew";
  EXPECT_EQ(nodesHeld({}), around * around * around) << "zeros";
  EXPECT_EQ(nodesHeld({ { 13, 0, 9 } }), 11 * 11 * around) << "at the lattice's end";
}

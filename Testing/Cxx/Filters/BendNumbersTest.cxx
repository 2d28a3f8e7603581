// SPDX-License-Identifier: BSD-3-Clause
// Proves that the numbers by which MPI ranks compare their deformations differ wherever the
// deformations do, and not where a processor rounds in another way.
#include "Filters/Attached/BendNumbers.h"
#include "Filters/Attached/DeformableVolume.h"
#include "Testing/Cxx/Filters/TestPipeline.h"

#include "vtkDummyController.h"

#include <gtest/gtest.h>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
constexpr float RoundingOfFloat = 1.2e-7f;

// A lattice in which each control point is moved in another way, by up to 3 mm.
Deformation someDeformation()
{
  Deformation deformation;
  Lattice& lattice = deformation.lattice;
  lattice.grid = plainGrid(glm::ivec3(9, 8, 7), glm::dvec3(4.0));
  for (std::size_t point = 0; point < lattice.grid.count(); ++point)
  {
    const auto at = static_cast<float>(point);
    lattice.displacements.emplace_back(
      3.0f * std::sin(at), std::cos(2.0f * at), 0.1f * std::sin(3.0f * at));
  }
  return deformation;
}

std::vector<BendNumber> numbersOf(const Deformation& deformation)
{
  vtkNew<vtkImageData> volume;
  attach(volume, deformation);
  return bendNumbersOf(volume);
}

bool areSame(const Deformation& one, const Deformation& other)
{
  const std::vector<BendNumber> a = numbersOf(one);
  const std::vector<BendNumber> b = numbersOf(other);
  EXPECT_EQ(a.size(), b.size());
  bool same = true;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    same = same && std::abs(a[i].value - b[i].value) <= 1e-5 * std::max(a[i].scale, b[i].scale);
  }
  return same;
}
}

TEST(BendNumbers, DifferWhereOneControlPointDoes)
{
  const Deformation deformation = someDeformation();
  for (const std::size_t point : { 0, 100, 503 })
  {
    Deformation other = deformation;
    other.lattice.displacements[point].y += 0.05f;
    EXPECT_FALSE(areSame(deformation, other)) << point;
  }
  Deformation other = deformation;
  std::swap(other.lattice.displacements[3], other.lattice.displacements[4]);
  EXPECT_FALSE(areSame(deformation, other)) << "two that changed their places";
}

TEST(BendNumbers, DifferWhereASettingDoes)
{
  const Deformation deformation = someDeformation();
  Deformation other = deformation;
  other.samples = 5;
  EXPECT_FALSE(areSame(deformation, other));
  other = deformation;
  other.inverse = Inverse::Negated;
  EXPECT_FALSE(areSame(deformation, other));
  other = deformation;
  other.strength = 0.99;
  EXPECT_FALSE(areSame(deformation, other));
  other = deformation;
  other.lattice.grid.origin.x += 0.01;
  EXPECT_FALSE(areSame(deformation, other));
  other = deformation;
  NodeWeights weights{ 5, std::vector<float>(41 * 36 * 31, 1.0f) };
  other.lattice.mask = std::make_shared<const NodeWeights>(weights);
  EXPECT_FALSE(areSame(deformation, other)) << "a mask that holds nothing back";
  Deformation masked = other;
  weights.values[700] = 0.5f;
  masked.lattice.mask = std::make_shared<const NodeWeights>(weights);
  EXPECT_FALSE(areSame(other, masked));
}

TEST(BendNumbers, AreThoseOfARoundedDeformation)
{
  const Deformation deformation = someDeformation();
  Deformation other = deformation;
  for (glm::vec3& displacement : other.lattice.displacements)
  {
    displacement *= 1.0f + 3.0f * RoundingOfFloat;
  }
  EXPECT_NE(deformation.lattice.displacements, other.lattice.displacements);
  EXPECT_TRUE(areSame(deformation, other));
}

TEST(BendNumbers, OfNoDeformationAreZero)
{
  vtkNew<vtkImageData> plain;
  const std::vector<BendNumber> none = bendNumbersOf(plain);
  EXPECT_EQ(none.size(), numbersOf(someDeformation()).size());
  for (const BendNumber& number : none)
  {
    EXPECT_EQ(number.value, 0.0);
  }
  EXPECT_EQ(bendNumbersOf(nullptr).size(), none.size());
}

TEST(BendNumbers, OfOneProcessAreItsOwn)
{
  vtkNew<vtkDummyController> alone;
  EXPECT_TRUE(areSameOnAll(alone, numbersOf(someDeformation())));
}

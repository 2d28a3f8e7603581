// SPDX-License-Identifier: BSD-3-Clause
// Proves that a fitted lattice is known by its settings, its box and all weights of its mask, that
// what differs is named with both values, and that files of the former version are still judged.
#include "Filters/Fields/BaseLattice.h"

#include "Common/FieldWord.h"
#include "Filters/Deformation/Kernels.h"
#include "Testing/Cxx/Filters/TestPipeline.h"

#include <gtest/gtest.h>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
constexpr int Samples = 1;

Lattice still()
{
  return makeLattice(
    { glm::ivec3(4, 5, 6), glm::dvec3(-10.0, 2.0, 5.0), glm::dvec3(3.0, 2.5, 2.0) },
    KernelCatmullRom);
}

// A lattice of which every node but one moves all the way. The mean of its weights is the same for
// each node.
Lattice heldAt(std::size_t node)
{
  Lattice lattice = still();
  NodeWeights weights{ Samples + 1, std::vector<float>(7 * 9 * 11, 1.0f) };
  weights.values[node] = 0.25f;
  lattice.mask = std::make_shared<const NodeWeights>(weights);
  return lattice;
}

vtkSmartPointer<vtkImageData> fittedFor(const Lattice& lattice)
{
  auto image = imageOn(lattice.grid);
  attachFittedFor(image, lattice, Samples);
  return image;
}

void expectIn(const std::string& words, const std::string& part)
{
  EXPECT_NE(words.find(part), std::string::npos) << words << "\n" << part;
}

// As the former version wrote it.
vtkSmartPointer<vtkImageData> formerlyFittedFor(const std::string& words)
{
  auto image = imageOn(still().grid);
  setFieldWord(image, "FittedFor", words);
  return image;
}
}

TEST(FittedFor, SaysNothingWhereNothingDiffers)
{
  EXPECT_EQ(wordsOnFittedFor(fittedFor(still()), still(), Samples), "");
  EXPECT_EQ(wordsOnFittedFor(fittedFor(heldAt(3)), heldAt(3), Samples), "");
  EXPECT_EQ(wordsOnFittedFor(imageOn(still().grid), still(), Samples), "") << "it is no fit";
  EXPECT_EQ(wordsOnFittedFor(nullptr, still(), Samples), "");
}

TEST(FittedFor, TellsMasksOfEqualSumApart)
{
  for (const std::size_t node : { 0, 1, 8, 346, 692 })
  {
    expectIn(wordsOnFittedFor(fittedFor(heldAt(3)), heldAt(node), Samples),
      "This deformation has another mask that lets 99.8918 % move");
  }
}

TEST(FittedFor, ForgivesTheRoundingOfWeightsAndBox)
{
  Lattice rounded = heldAt(3);
  NodeWeights weights = *rounded.mask;
  for (float& weight : weights.values)
  {
    weight *= 1.0f - 1e-8f;
  }
  rounded.mask = std::make_shared<const NodeWeights>(weights);
  rounded.grid.origin.x *= 1.0 + 1e-13;
  EXPECT_EQ(wordsOnFittedFor(fittedFor(heldAt(3)), rounded, Samples), "");
}

TEST(FittedFor, NamesEachSettingWithBothValues)
{
  Lattice smooth = still();
  smooth.kernel = KernelBSpline;
  EXPECT_EQ(wordsOnFittedFor(fittedFor(still()), smooth, 3),
    "The base lattice was fitted for Kernel Catmull-Rom, Samples 1. This deformation has Kernel "
    "B-Spline, Samples 3. The figures of the fit are not valid for it. Give Fit Deformation the "
    "same settings and Input");
  Lattice finer = still();
  finer.grid = withDimensions(finer.grid, glm::ivec3(7, 5, 6));
  const std::string words = wordsOnFittedFor(fittedFor(still()), finer, Samples);
  expectIn(words, "Lattice Dimensions 4 x 5 x 6. This deformation has");
  expectIn(words, "Lattice Dimensions 7 x 5 x 6");
  EXPECT_EQ(words.find("box"), std::string::npos) << words;
  expectIn(wordsOnFittedFor(fittedFor(still()), heldAt(3), Samples),
    "no mask. This deformation has a mask that lets 99.8918 % move");
  Lattice aside = still();
  aside.grid.origin.x += 1.0;
  expectIn(wordsOnFittedFor(fittedFor(still()), aside, Samples),
    "from -10 2 5 to -1 12 15 mm. This deformation has the box from -9 2 5 to 0 12 15");
  Lattice hardlyAside = still();
  hardlyAside.grid.origin.y += 4e-6; // more than rounding, less than the digits show
  expectIn(wordsOnFittedFor(fittedFor(still()), hardlyAside, Samples),
    "This deformation has another box from -10 2 5 to -1 12 15 mm");
}

TEST(FittedFor, JudgesFilesOfTheFormerVersion)
{
  const std::string plain = "4 x 5 x 6 control points, kernel Catmull-Rom, Samples 1, ";
  EXPECT_EQ(wordsOnFittedFor(formerlyFittedFor(plain + "no mask"), still(), Samples), "");
  expectIn(wordsOnFittedFor(formerlyFittedFor(plain + "no mask"), still(), 2),
    "Samples 1. This deformation has Samples 2");
  const auto masked = formerlyFittedFor(plain + "a mask that lets 99.891775 % move");
  EXPECT_EQ(wordsOnFittedFor(masked, heldAt(3), Samples), "") << "it knew the mean alone";
  expectIn(wordsOnFittedFor(masked, still(), Samples), "no mask");
  const auto other = formerlyFittedFor(plain + "a mask that lets 99.891778 % move");
  expectIn(wordsOnFittedFor(other, heldAt(3), Samples), "another mask");
}

// SPDX-License-Identifier: BSD-3-Clause
// Proves that an array whose values lie in pieces has each value of an array in one piece, in runs
// and one by one, for the types and components that volumes have.
#include "Common/PiecedArray.h"

#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkSOADataArrayTemplate.h"
#include "vtkShortArray.h"
#include "vtkUnsignedCharArray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

using namespace brainshift;

namespace
{
constexpr Extent Wanted{ -3, 8, 5, 16, 2, 12 };
constexpr Extent Held{ 1, 20, -4, 11, 4, 9 }; // some of the wanted values, and others

// A number for each place and component. Extents count values.
double numberAt(int x, int y, int z, int component)
{
  return ((z * 31 + y) * 37 + x) % 113 + 0.0 + component;
}

template <typename Array>
vtkSmartPointer<vtkDataArray> numbersOf(const Extent& extent, int components)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName("Numbers");
  array->SetNumberOfComponents(components);
  for (int z = extent[4]; z <= extent[5]; ++z)
  {
    for (int y = extent[2]; y <= extent[3]; ++y)
    {
      for (int x = extent[0]; x <= extent[1]; ++x)
      {
        std::array<double, 4> tuple{};
        for (int c = 0; c < components; ++c)
        {
          tuple[c] = numberAt(x, y, z, c);
        }
        array->InsertNextTuple(tuple.data());
      }
    }
  }
  return array;
}

template <typename Array>
ArrayPiece pieceOf(const Extent& box, int components)
{
  return { box, box, numbersOf<Array>(box, components) };
}

template <typename Array, typename Number>
void expectAsInOnePiece(const vtkSmartPointer<vtkDataArray>& held, int components)
{
  const auto whole = numbersOf<Array>(Wanted, components);
  const vtkIdType count = whole->GetNumberOfTuples();
  const vtkSmartPointer<vtkDataArray> pieced = arrayOfPieces(Wanted,
    { pieceOf<Array>({ -3, 8, 5, 16, 2, 3 }, components),
      pieceOf<Array>({ -3, 8, 5, 16, 10, 12 }, components),
      pieceOf<Array>({ -3, 8, 12, 16, 4, 9 }, components),
      pieceOf<Array>({ -3, 0, 5, 11, 4, 9 }, components), { Held, Held, held } });
  EXPECT_FALSE(pieced->HasStandardMemoryLayout());
  EXPECT_STREQ(pieced->GetName(), "Numbers");
  ASSERT_EQ(pieced->GetNumberOfTuples(), count);
  ASSERT_EQ(pieced->GetNumberOfComponents(), components);
  for (int c = 0; c < components; ++c)
  {
    for (vtkIdType i = 0; i < count; ++i)
    {
      ASSERT_EQ(pieced->GetComponent(i, c), whole->GetComponent(i, c)) << i << " " << c;
    }
    double range[2];
    double expected[2];
    pieced->GetFiniteRange(range, c);
    whole->GetFiniteRange(expected, c);
    EXPECT_EQ(range[0], expected[0]);
    EXPECT_EQ(range[1], expected[1]);
  }
  const vtkSmartPointer<vtkDataArray> copy = contiguous(pieced);
  ASSERT_TRUE(copy->HasStandardMemoryLayout());
  const auto* expected = static_cast<const Number*>(whole->GetVoidPointer(0));
  EXPECT_TRUE(std::equal(
    expected, expected + count * components, static_cast<const Number*>(copy->GetVoidPointer(0))));
  EXPECT_TRUE(std::equal(expected, expected + count * components,
    static_cast<const Number*>(pieced->GetVoidPointer(0))));

  // Runs follow each other, also where a piece of a loop begins within one.
  std::mt19937 random(4);
  for (int i = 0; i < 200; ++i)
  {
    const vtkIdType first = std::uniform_int_distribution<vtkIdType>(0, count)(random);
    const vtkIdType end = std::uniform_int_distribution<vtkIdType>(first, count)(random);
    vtkIdType next = first;
    forEachRun<Number>(pieced, first, end, [&](vtkIdType at, const Number* run, vtkIdType length) {
      ASSERT_EQ(at, next);
      EXPECT_TRUE(std::equal(run, run + length * components, expected + at * components));
      next += length;
    });
    ASSERT_EQ(next, end);
  }
}
}

TEST(PiecedArray, HasTheValuesOfOnePiece)
{
  expectAsInOnePiece<vtkFloatArray, float>(numbersOf<vtkFloatArray>(Held, 1), 1);
  expectAsInOnePiece<vtkShortArray, short>(numbersOf<vtkShortArray>(Held, 1), 1);
  expectAsInOnePiece<vtkUnsignedCharArray, unsigned char>(
    numbersOf<vtkUnsignedCharArray>(Held, 4), 4);
}

// Of a filter that keeps each component apart.
TEST(PiecedArray, TakesPiecesOfAnyLayout)
{
  using Apart = vtkSOADataArrayTemplate<float>;
  expectAsInOnePiece<vtkFloatArray, float>(numbersOf<Apart>(Held, 3), 3);
}

TEST(PiecedArray, LeavesOnePieceAsItIs)
{
  const ArrayPiece piece = pieceOf<vtkFloatArray>(Wanted, 1);
  EXPECT_EQ(arrayOfPieces(Wanted, { piece }), piece.values);
  EXPECT_EQ(contiguous(piece.values), piece.values);
}

// SPDX-License-Identifier: BSD-3-Clause
// Proves that arrays over the numbers of others have the ranges that VTK finds, for every type,
// with NaN and infinite numbers, and that the ranges follow the numbers.
#include "Common/SharedArray.h"

#include <vtkAOSDataArrayTemplate.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <random>
#include <type_traits>

using namespace brainshift;

namespace
{
// The range that a data set answers, as ParaView asks for it.
std::vector<double> rangesOf(vtkDataArray* array)
{
  vtkNew<vtkPointData> fields;
  fields->AddArray(array);
  std::vector<double> ranges;
  for (int i = 0; i < array->GetNumberOfComponents(); ++i)
  {
    double range[2];
    fields->GetRange(array->GetName(), range, i);
    ranges.insert(ranges.end(), range, range + 2);
    fields->GetFiniteRange(array->GetName(), range, i);
    ranges.insert(ranges.end(), range, range + 2);
  }
  return ranges;
}

template <typename T>
vtkSmartPointer<vtkAOSDataArrayTemplate<T>> someNumbers(vtkIdType tuples, int components)
{
  auto array = vtk::TakeSmartPointer(vtkAOSDataArrayTemplate<T>::New());
  array->SetName("numbers");
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  std::mt19937 random(static_cast<unsigned>(tuples));
  std::uniform_int_distribution<int> number(std::is_signed<T>::value ? -100 : 3, 120);
  for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i)
  {
    array->SetValue(i, static_cast<T>(number(random)));
  }
  return array;
}

template <typename T>
class SharedArrayOf : public ::testing::Test
{
};
using Types = ::testing::Types<char, signed char, unsigned char, short, unsigned short, int,
  unsigned int, long long, unsigned long long, float, double>;
TYPED_TEST_SUITE(SharedArrayOf, Types);

TYPED_TEST(SharedArrayOf, HasTheRangesOfVTK)
{
  constexpr vtkIdType threads = 2500000; // more than one thread reads
  for (const int components : { 1, 2, 3, 4, 6 })
  {
    for (const vtkIdType tuples : { vtkIdType(1), vtkIdType(15), vtkIdType(16), vtkIdType(17),
           vtkIdType(1001), components == 1 ? threads : vtkIdType(33) })
    {
      const auto source = someNumbers<TypeParam>(tuples, components);
      // The last tuple of all, which no whole group of lanes holds.
      source->SetValue(source->GetNumberOfValues() - 1, TypeParam(125));
      EXPECT_EQ(rangesOf(sharedAs("numbers", source)), rangesOf(source))
        << tuples << " tuples of " << components;
    }
  }
}

template <typename T>
class SharedArrayOfReal : public ::testing::Test
{
};
using RealTypes = ::testing::Types<float, double>;
TYPED_TEST_SUITE(SharedArrayOfReal, RealTypes);

TYPED_TEST(SharedArrayOfReal, CountsNoNaNAndInfiniteNumbersOnlyAmongAll)
{
  using Limits = std::numeric_limits<TypeParam>;
  for (const vtkIdType at : { 0, 20, 998, 1000 })
  {
    for (const TypeParam special : { Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity() })
    {
      const auto source = someNumbers<TypeParam>(1001, 1);
      source->SetValue(at, special);
      EXPECT_EQ(rangesOf(sharedAs("numbers", source)), rangesOf(source)) << special << " at " << at;
    }
  }
  const auto none = someNumbers<TypeParam>(100, 1);
  none->Fill(Limits::quiet_NaN());
  EXPECT_EQ(rangesOf(sharedAs("numbers", none)), rangesOf(none));
}

TEST(SharedArray, FollowsItsNumbersThroughASecondArray)
{
  const auto source = someNumbers<unsigned char>(1000, 1);
  const auto first = sharedAs("first", source);
  const auto second = sharedAs("second", first);
  EXPECT_EQ(rangesOf(second), rangesOf(source));
  source->SetValue(500, 222);
  source->Modified();
  EXPECT_EQ(first->GetRange()[1], 222.0);
  first->Modified();
  EXPECT_EQ(rangesOf(second)[1], 222.0);
}
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Attached/BendNumbers.h"

#include "Common/Guard.h"
#include "Common/RankAgreement.h"
#include "Filters/Attached/DeformableVolume.h"

#include "vtkCommunicator.h"
#include "vtkMultiProcessController.h"

#include <cmath>
#include <cstdint>

namespace brainshift
{
namespace
{
constexpr double RoundingOfScale = 1e-5;
constexpr std::size_t NumbersOfBend = 17;

// -1 to 1, without order: sums with such weights do not hide what differs in two places.
double weightOf(std::uint64_t index)
{
  std::uint64_t bits = (index + 1) * 0x9e3779b97f4a7c15ULL; // splitmix64
  bits = (bits ^ (bits >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  bits = (bits ^ (bits >> 27U)) * 0x94d049bb133111ebULL;
  return static_cast<double>(static_cast<std::int64_t>(bits ^ (bits >> 31U))) / 9.3e18;
}

// The weighted sum of a number of values, and their root sum of squares.
template <typename Value>
BendNumber sumOf(std::size_t count, const Value& value)
{
  BendNumber sum;
  for (std::size_t i = 0; i < count; ++i)
  {
    const double term = value(i);
    sum.value += weightOf(i) * term;
    sum.scale += term * term;
  }
  sum.scale = std::sqrt(sum.scale);
  return sum;
}
}

std::vector<BendNumber> bendNumbersOf(vtkDataObject* volume)
{
  std::vector<BendNumber> numbers;
  if (carriesDeformation(volume))
  {
    const Deformation deformation = readDeformation(volume);
    const Lattice lattice = effectiveLattice(deformation);
    const auto add = [&](double value, double scale) { numbers.push_back({ value, scale }); };
    add(1.0, 0.0);
    add(lattice.kernel, 0.0);
    add(deformation.samples, 0.0);
    add(static_cast<double>(deformation.inverse), 0.0);
    for (int axis = 0; axis < 3; ++axis)
    {
      const double spacing = lattice.grid.spacing[axis];
      add(lattice.grid.dimensions[axis], 0.0);
      add(spacing, spacing);
      add(lattice.grid.origin[axis], spacing);
      numbers.push_back(sumOf(lattice.displacements.size(),
        [&](std::size_t point) { return lattice.displacements[point][axis]; }));
    }
    const auto& mask = lattice.mask;
    numbers.push_back(
      sumOf(mask ? mask->values.size() : 0, [&](std::size_t node) { return mask->values[node]; }));
  }
  numbers.resize(NumbersOfBend);
  return numbers;
}

bool areSameOnAll(vtkMultiProcessController* ranks, const std::vector<BendNumber>& here)
{
  std::vector<double> own; // of each number the largest, the smallest negated, and the scale
  for (const BendNumber& number : here)
  {
    own.insert(own.end(), { number.value, -number.value, number.scale });
  }
  std::vector<double> all = own;
  ranks->AllReduce(
    own.data(), all.data(), static_cast<vtkIdType>(own.size()), vtkCommunicator::MAX_OP);
  bool same = true;
  for (std::size_t i = 0; i < all.size(); i += 3)
  {
    same = same && all[i] + all[i + 1] <= RoundingOfScale * all[i + 2];
  }
  return same;
}

std::string bendProblem(vtkMultiProcessController* ranks, vtkDataObject* volume)
{
  std::vector<BendNumber> numbers;
  const std::string problem = problemOnAny(
    ranks, sentenceThrownBy("its deformation", [&] { numbers = bendNumbersOf(volume); }));
  const bool isSame = problem.empty() && areSameOnAll(ranks, numbers);
  return isSame || !problem.empty()
    ? problem
    : "The MPI ranks bend the volume in different ways: one of them could not follow, and reported "
      "why";
}
}

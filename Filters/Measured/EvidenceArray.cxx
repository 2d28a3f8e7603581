// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Measured/EvidenceArray.h"

#include "Filters/Attached/DeformableVolume.h"
#include "Filters/Fit/FittedLattice.h"
#include "Formats/Fields/FieldImage.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"

namespace brainshift
{
namespace
{
// What strokes and Strength add to the lattice of a fit; whether they add anything.
bool handOf(const Lattice& start, const Deformation& drawn, Lattice& hand)
{
  hand = effectiveLattice(drawn);
  bool moves = false;
  for (std::size_t i = 0; i < hand.displacements.size(); ++i)
  {
    hand.displacements[i] -= start.displacements[i];
    moves = moves || hand.displacements[i] != glm::vec3(0.0f);
  }
  return moves;
}
}

void addEvidence(vtkImageData* lattice, const FittedLattice& fitted, LatticeEvidence& evidence)
{
  const std::vector<float> deviations = evidence.deviations(fitted);
  vtkNew<vtkFloatArray> array;
  array->SetName(DeviationName);
  array->SetNumberOfValues(static_cast<vtkIdType>(deviations.size()));
  std::copy(deviations.begin(), deviations.end(), array->GetPointer(0));
  lattice->GetPointData()->AddArray(array);
}

std::vector<float> drawnDeviations(
  vtkImageData* base, const Lattice& start, const Deformation& drawn)
{
  auto array =
    base ? vtkFloatArray::FastDownCast(base->GetPointData()->GetArray(DeviationName)) : nullptr;
  // Whoever else made an array of this name may have meant something else by it.
  const auto isDeviation = [](float mm) { return mm >= 0.0f; }; // false for NaN
  if (!array || drawn.inverse != Inverse::Exact || array->GetNumberOfComponents() != 1 ||
    !(gridOf(base) == start.grid) ||
    !std::all_of(
      array->GetPointer(0), array->GetPointer(0) + array->GetNumberOfValues(), isDeviation))
  {
    return {};
  }
  std::vector<float> deviations(
    array->GetPointer(0), array->GetPointer(0) + array->GetNumberOfValues());
  Lattice hand;
  if (!handOf(start, drawn, hand))
  {
    return deviations;
  }
  const PointMap map(hand);
  std::size_t point = 0;
  forEachIndex(glm::ivec3(0), hand.grid.dimensions - 1, [&](const glm::ivec3& index) {
    const glm::dvec3 rest = hand.grid.worldFromGrid(glm::dvec3(index));
    const double away = glm::distance(map.deformedFromRest(rest), rest);
    deviations[point] = static_cast<float>(withDistance(deviations[point], away));
    ++point;
  });
  return deviations;
}
}

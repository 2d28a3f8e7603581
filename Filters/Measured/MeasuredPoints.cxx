// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Measured/MeasuredPoints.h"

#include "Filters/Fit/LandmarkMatch.h"

#include "vtkAbstractArray.h"
#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkVariant.h"

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include <cstddef>

namespace brainshift
{
namespace
{
std::vector<std::string> labelsOfPoints(vtkPointSet* points)
{
  std::vector<std::string> labels(points ? points->GetNumberOfPoints() : 0);
  vtkAbstractArray* array = points ? points->GetPointData()->GetAbstractArray("Label") : nullptr;
  for (std::size_t i = 0; array && i < labels.size(); ++i)
  {
    labels[i] = array->GetVariantValue(static_cast<vtkIdType>(i)).ToString();
  }
  return labels;
}

std::string joined(const std::vector<std::string>& words)
{
  std::string text;
  for (const std::string& word : words)
  {
    text += (text.empty() ? "" : ", ") + word;
  }
  return text;
}
}

std::vector<glm::dvec3> positionsOf(vtkPointSet* points)
{
  std::vector<glm::dvec3> positions(points ? points->GetNumberOfPoints() : 0);
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    points->GetPoint(static_cast<vtkIdType>(i), &positions[i].x);
  }
  return positions;
}

std::vector<PointPair> landmarkPairs(
  vtkPointSet* rest, vtkPointSet* measured, std::string& unmatched)
{
  const std::vector<glm::dvec3> from = positionsOf(rest);
  const std::vector<glm::dvec3> to = positionsOf(measured);
  vtkDataArray* weights = rest ? rest->GetPointData()->GetArray("Weight") : nullptr;
  const LandmarkMatch match = matchLandmarks(labelsOfPoints(rest), labelsOfPoints(measured));
  std::vector<PointPair> pairs;
  for (const auto& [i, partner] : match.pairs)
  {
    const double weight = weights ? weights->GetComponent(static_cast<vtkIdType>(i), 0) : 1.0;
    pairs.push_back({ from[i], to[partner], weight });
  }
  unmatched = joined(match.unmatched);
  return pairs;
}

bool holds(const Mask& mask, const glm::dvec3& position)
{
  const glm::dvec3 nearest = glm::floor(mask.grid.gridFromWorld(position) + 0.5);
  if (!glm::all(glm::greaterThanEqual(nearest, glm::dvec3(0.0))) ||
    !glm::all(glm::lessThan(nearest, glm::dvec3(mask.grid.dimensions))))
  {
    return false;
  }
  const glm::ivec3 at(nearest);
  return mask.inside[mask.grid.offset(at.x, at.y, at.z)] != 0;
}
}

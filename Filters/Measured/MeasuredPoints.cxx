// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Measured/MeasuredPoints.h"

#include "Filters/Fit/PackedTables.h"

#include "vtkAbstractArray.h"
#include "vtkAppendFilter.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkMultiProcessController.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVariant.h"

#include <map>
#include <set>

namespace brainshift
{
namespace
{
constexpr std::size_t MostNamed = 10; // a message must stay readable

// The points with their arrays, without cells.
vtkSmartPointer<vtkPolyData> withPointsOnly(vtkPointSet* points)
{
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(points->GetPoints());
  result->GetPointData()->ShallowCopy(points->GetPointData());
  return result;
}

bool isSame(vtkPointSet* one, vtkPointSet* other)
{
  return positionsOf(one) == positionsOf(other);
}

// The names of points: those of their own array, else of another list.
std::vector<std::string> labelsOfPoints(vtkPointSet* points, const std::vector<std::string>& others)
{
  std::vector<std::string> labels(others);
  labels.resize(points ? points->GetNumberOfPoints() : 0);
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
  for (std::size_t i = 0; i < words.size() && i < MostNamed; ++i)
  {
    text += (text.empty() ? "" : ", ") + words[i];
  }
  return words.size() <= MostNamed
    ? text
    : text + " and " + std::to_string(words.size() - MostNamed) + " more";
}

// Gives each landmark a name of its own: of several F, the second is "F (2)".
void nameApart(std::vector<std::string>& names)
{
  std::map<std::string, int> seen;
  std::set<std::string> taken(names.begin(), names.end());
  for (std::string& name : names)
  {
    const std::string label = name;
    for (int number = ++seen[label]; number > 1; ++number)
    {
      name = label + " (" + std::to_string(number) + ")";
      if (taken.insert(name).second)
      {
        break;
      }
    }
  }
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

NamedPairs landmarkPairs(vtkPointSet* rest, vtkPointSet* measured, const PairingRule& rule)
{
  const std::vector<glm::dvec3> from = positionsOf(rest);
  const std::vector<glm::dvec3> to = positionsOf(measured);
  const std::vector<std::string> labels = labelsOfPoints(rest, rule.restNames);
  vtkDataArray* weights = rest ? rest->GetPointData()->GetArray("Weight") : nullptr;
  const LandmarkMatch match =
    matchLandmarks(labels, labelsOfPoints(measured, rule.measuredNames), rule.byOrder);
  NamedPairs named;
  for (const auto& [i, partner] : match.pairs)
  {
    const double weight = weights ? weights->GetComponent(static_cast<vtkIdType>(i), 0) : 1.0;
    named.pairs.push_back({ from[i], to[partner], weight });
    named.names.push_back(labels[i].empty() ? std::to_string(i + 1) : labels[i]);
  }
  named.unmatched = joined(match.unmatched);
  named.repeated = joined(match.repeated);
  return named;
}

void askForOwnPoints(vtkInformation* points)
{
  vtkMultiProcessController* ranks = vtkMultiProcessController::GetGlobalController();
  if (points && ranks)
  {
    using Pipeline = vtkStreamingDemandDrivenPipeline;
    points->Set(Pipeline::UPDATE_PIECE_NUMBER(), ranks->GetLocalProcessId());
    points->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), ranks->GetNumberOfProcesses());
    points->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
  }
}

vtkSmartPointer<vtkPointSet> pointsOfAllRanks(vtkPointSet* own)
{
  vtkMultiProcessController* ranks = vtkMultiProcessController::GetGlobalController();
  if (!own || !ranks || ranks->GetNumberOfProcesses() == 1)
  {
    return own;
  }
  std::vector<vtkSmartPointer<vtkDataObject>> parts;
  ranks->AllGather(withPointsOnly(own), parts);
  const bool isCopied = std::all_of(parts.begin(), parts.end(), [&](vtkDataObject* part) {
    return isSame(vtkPointSet::SafeDownCast(part), vtkPointSet::SafeDownCast(parts.front()));
  });
  if (isCopied)
  {
    return own;
  }
  vtkNew<vtkAppendFilter> append; // an array counts if all parts with points have it
  for (vtkDataObject* part : parts)
  {
    append->AddInputData(part);
  }
  append->Update();
  return append->GetOutput();
}

NearMask::NearMask(const Mask& mask, double byMm)
  : Voxels(mask)
  , ByMm(byMm)
  , First(mask.grid.dimensions)
{
  std::size_t voxel = 0;
  forEachIndex(glm::ivec3(0), mask.grid.dimensions - 1, [&](const glm::ivec3& index) {
    if (mask.inside[voxel++])
    {
      this->First = glm::min(this->First, index);
      this->Behind = glm::max(this->Behind, index + 1);
    }
  });
}

bool NearMask::holds(const glm::dvec3& position) const
{
  const Grid& grid = this->Voxels.grid;
  const glm::dvec3 at = grid.gridFromWorld(position);
  const glm::dvec3 radius = this->ByMm / grid.spacing; // voxels
  // Clamped as doubles: a far position is no int.
  const glm::dvec3 least(this->First);
  const glm::dvec3 most(this->Behind);
  const glm::ivec3 begin(glm::clamp(glm::ceil(at - radius), least, glm::max(least, most)));
  const glm::ivec3 end(glm::clamp(glm::floor(at + radius) + 1.0, glm::min(least, most), most));
  for (int z = begin.z; z < end.z; ++z)
  {
    for (int y = begin.y; y < end.y; ++y)
    {
      for (int x = begin.x; x < end.x; ++x)
      {
        const glm::dvec3 away = (glm::dvec3(x, y, z) - at) * grid.spacing;
        if (this->Voxels.inside[grid.offset(x, y, z)] &&
          glm::dot(away, away) <= this->ByMm * this->ByMm)
        {
          return true;
        }
      }
    }
  }
  return false;
}

NamedPairs FitLandmarks::read(vtkPointSet* rest, vtkPointSet* measured)
{
  NamedPairs named = landmarkPairs(rest, measured, this->Rule);
  nameApart(named.names);
  for (std::size_t i = 0; i < named.pairs.size(); ++i)
  {
    const bool isOff = std::find(this->SwitchedOff.begin(), this->SwitchedOff.end(),
                         named.names[i]) != this->SwitchedOff.end();
    named.pairs[i].weight = isOff ? 0.0 : named.pairs[i].weight;
  }
  const std::vector<PointPair> listed = rowsFrom<PointPair>(this->Numbers);
  for (std::size_t i = 0; i < listed.size(); ++i)
  {
    named.pairs.push_back(listed[i]);
    named.names.push_back("Pair " + std::to_string(i + 1));
  }
  this->Names->Reset();
  for (const std::string& name : named.names)
  {
    this->Names->InsertNextValue(name);
  }
  return named;
}

void FitLandmarks::place(const FittedLattice& fitted, const std::vector<PointPair>& pairs)
{
  this->Places->Reset();
  this->Places->SetNumberOfComponents(NumbersPerPlace);
  for (std::size_t i = 0; fitted.isKnown() && i < pairs.size(); ++i)
  {
    const auto& [rest, measured, weight] = pairs[i];
    const glm::dvec3 at = fitted.measuredFromRest(rest);
    const double tuple[NumbersPerPlace] = { rest.x, rest.y, rest.z, measured.x, measured.y,
      measured.z, at.x, at.y, at.z, weight };
    this->Places->InsertNextTuple(tuple);
  }
}

std::vector<double> leaveOneOut(const FittedLattice& fitted, const std::vector<PointPair>& pairs)
{
  std::vector<double> errors = fitted.fit().leaveOneOut();
  for (std::size_t i = 0; i < errors.size() && i < pairs.size(); ++i)
  {
    const bool isKnown = std::isfinite(fitted.fit().deviation(pairs[i].rest));
    if (!isOn(pairs[i]) && isKnown)
    {
      errors[i] = glm::distance(fitted.fit().measuredFromRest(pairs[i].rest), pairs[i].measured);
    }
  }
  return errors;
}
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Measured/FitLandmarks.h"

#include "Filters/Fit/PackedTables.h"

#include "Filters/Measured/MeasuredPoints.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace brainshift
{
namespace
{
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

std::vector<PointPair> FitLandmarks::read(
  vtkPointSet* rest, vtkPointSet* measured, std::string& unmatched)
{
  NamedPairs named = landmarkPairs(rest, measured);
  unmatched = named.unmatched;
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
  return named.pairs;
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

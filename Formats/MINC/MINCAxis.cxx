// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/MINC/MINCAxis.h"

#include "Formats/Files/Text.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace brainshift
{
namespace
{
constexpr std::uint64_t MostSteps = 65536;        // and numbers for a voxel: each takes memory
constexpr std::uint64_t LongestSide = 2147483647; // of VTK
constexpr double LargestUnreportedErrorMm = 1e-3; // of an uneven axis that is shown evenly

// Millimetres or seconds by the words for units.
const std::map<std::string, double> MmPerUnit{ { "", 1.0 }, { "mm", 1.0 }, { "cm", 10.0 },
  { "m", 1000.0 }, { "um", 1e-3 }, { "millimeters", 1.0 }, { "millimetres", 1.0 } };
const std::map<std::string, double> SecondsPerUnit{ { "", 1.0 }, { "s", 1.0 }, { "sec", 1.0 },
  { "seconds", 1.0 }, { "ms", 1e-3 }, { "msec", 1e-3 }, { "us", 1e-6 }, { "min", 60.0 } };

double factorOf(const std::map<std::string, double>& factors, const MINCAxis& axis)
{
  const auto known = factors.find(lowerCase(axis.units));
  if (known == factors.end())
  {
    std::string words;
    for (const auto& [word, factor] : factors)
    {
      words += (words.empty() || word.empty() ? "" : ", ") + word;
    }
    throw Problem("has the units '" + shownWords(axis.units) + "' along " + axis.name +
      "; BrainShift reads " + words);
  }
  return known->second;
}

bool grows(const std::vector<double>& numbers)
{
  const auto isNotAbove = [](double a, double b) { return !(a < b); }; // also rejects NaN
  return std::adjacent_find(numbers.begin(), numbers.end(), isNotAbove) == numbers.end() &&
    std::isfinite(numbers.front()) && std::isfinite(numbers.back());
}

// Gives an uneven axis of space the even spacing from its first position to its last one.
void makeEven(MINCAxis& axis, double mm, std::vector<std::string>& warnings)
{
  const std::vector<double>& positions = axis.positions;
  if (positions.size() < 2 || positions.front() == positions.back()) // zeros of libminc
  {
    warnings.push_back("has an uneven spacing along " + axis.name +
      ", but no list of its positions; it is shown with the even spacing " +
      std::to_string(axis.step));
    return;
  }
  if (!grows(positions) && !grows({ positions.rbegin(), positions.rend() }))
  {
    throw Problem("has positions along " + axis.name + " that neither grow nor fall");
  }
  axis.start = positions.front();
  axis.step = (positions.back() - positions.front()) / static_cast<double>(positions.size() - 1);
  double largest = 0.0;
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    const double even = axis.start + static_cast<double>(i) * axis.step;
    largest = std::max(largest, std::abs(positions[i] - even));
  }
  if (mm * largest > LargestUnreportedErrorMm)
  {
    warnings.push_back(
      joined("has an uneven spacing along ", axis.name, "; it is shown with the even spacing ",
        mm * axis.step, " mm, up to ", mm * largest, " mm from its positions"));
  }
}

// Times of the volumes, s.
std::vector<double> timesOf(const MINCAxis& axis, std::vector<std::string>& warnings)
{
  const double seconds = factorOf(SecondsPerUnit, axis);
  if (axis.count > 1 && !axis.isEven)
  {
    std::vector<double> times = axis.positions;
    std::for_each(times.begin(), times.end(), [seconds](double& time) { time *= seconds; });
    if (!times.empty() && grows(times))
    {
      return times;
    }
    warnings.push_back("has uneven times along " + axis.name +
      ", but no list of them that grows; " + "its volumes are numbered 0, 1, 2 and so on");
    return evenTimes(axis.count, 1.0);
  }
  if (axis.count > 1 && !(axis.step > 0.0))
  {
    warnings.push_back("has the step " + std::to_string(axis.step) + " along " + axis.name +
      ", which is no time; its volumes are numbered 0, 1, 2 and so on");
    return evenTimes(axis.count, 1.0);
  }
  return evenTimes(axis.count, seconds * axis.step, seconds * axis.start);
}

// Cosines count as directions alone.
void makeUnit(MINCAxis& axis, std::vector<std::string>& warnings)
{
  constexpr double Rounding = 1e-3; // of cosines with few digits
  const double length = glm::length(axis.cosines);
  if (!(length > 0.0) || !std::isfinite(length))
  {
    return; // refused with the matrix
  }
  if (std::abs(length - 1.0) > Rounding)
  {
    warnings.push_back(joined(
      "has direction_cosines along ", axis.name, " that are ", length, " long, which count as 1"));
  }
  axis.cosines /= length;
}

// Places voxels along the column `along` of the matrix.
void placeAlong(int along, MINCAxis& axis, VolumeHeader& header)
{
  makeUnit(axis, header.warnings);
  const double mm = factorOf(MmPerUnit, axis);
  if (!axis.isEven)
  {
    makeEven(axis, mm, header.warnings);
  }
  header.worldFromVoxel[along] = glm::dvec4(mm * axis.step * axis.cosines, 0.0);
  header.worldFromVoxel[3] += glm::dvec4(mm * axis.start * axis.cosines, 0.0);
  header.dimensions[along] = static_cast<int>(axis.count);
}
}

void placeMINC(std::vector<MINCAxis>& axes, VolumeHeader& header)
{
  int along = 2; // space counts from the fastest axis on
  int others = 0;
  header.worldFromVoxel[3] = glm::dvec4(0.0, 0.0, 0.0, 1.0);
  for (MINCAxis& axis : axes)
  {
    const std::uint64_t limit = axis.use == AxisUse::Space ? LongestSide : MostSteps;
    if (axis.count < 1 || axis.count > limit)
    {
      throw Problem("has " + std::to_string(axis.count) + " entries along " + axis.name +
        "; it must have from 1 to " + std::to_string(limit));
    }
    if (axis.use == AxisUse::Components && others++ > 0)
    {
      throw Problem(
        "has the dimension " + axis.name + ", which is none of space or time; only one may be");
    }
    if (axis.spaceType.rfind("talairach", 0) == 0) // stereotaxic: the MNI's templates, too
    {
      header.space = Template::Other;
    }
    if (axis.use == AxisUse::Space && along >= 0)
    {
      placeAlong(along, axis, header);
    }
    along -= axis.use == AxisUse::Space ? 1 : 0;
    if (axis.use == AxisUse::Time)
    {
      header.times = timesOf(axis, header.warnings);
    }
    header.components =
      axis.use == AxisUse::Components ? static_cast<int>(axis.count) : header.components;
  }
  if (along != -1)
  {
    throw Problem("has " + std::to_string(2 - along) + " axes in space; it must have 3");
  }
}
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Fit/PlaceDoubts.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

namespace brainshift
{
namespace
{
constexpr double ClosestMm = 1.0;       // extent of a list that is rather in metres
constexpr double FarthestRatio = 100.0; // of the extents of a list and the volume
constexpr double CmPerMm = 10.0;
constexpr double SmallShare = 1.0 / 12.0; // of the volume: the most of a list that is rather in cm
constexpr double TissueShare = 0.05;      // of the volume: the least of that list in mm
constexpr double BoxMargin = 0.1;         // of the volume, in which points may lie beyond it
constexpr double FarOutsideMm = 100.0;
constexpr double NearOutsideMm = 20.0; // the least for small volumes
constexpr std::size_t FewestVoxels = 3;
constexpr double LargestVoxelMm = 5.0; // lists within a larger one are no surprise
constexpr double RoundMm = 5.0;        // multiples of which people type

using Points = std::vector<glm::dvec3>;

// A list of points and how a sentence calls it.
struct PlaceList
{
  const char* name;
  Points points;
  bool isInFrame = true; // of the volume; else only its size counts
  Points ends = {};      // of pulls
};

// How far (mm) a point is outside a grid; 0 inside.
double outside(const Grid& grid, const glm::dvec3& point)
{
  const glm::dvec3 at = grid.gridFromWorld(point);
  const glm::dvec3 last(grid.dimensions - 1);
  return glm::length((at - glm::clamp(at, glm::dvec3(0.0), last)) * grid.spacing);
}

double diagonalOf(const Grid& grid)
{
  return grid.count() == 0 ? 0.0 : glm::length(grid.spacing * glm::dvec3(grid.dimensions - 1));
}

// Whether points that lie near the origin of the world would fill the volume in cm.
bool looksLikeCm(const Points& points, const Grid& volume)
{
  const double diagonal = diagonalOf(volume);
  const double extent = extentOf(points);
  const bool isSmall = points.size() > 1 && extent <= SmallShare * diagonal &&
    CmPerMm * extent >= TissueShare * diagonal;
  return isSmall && std::all_of(points.begin(), points.end(), [&](const glm::dvec3& point) {
    return glm::length(point) <= SmallShare * diagonal &&
      outside(volume, CmPerMm * point) <= BoxMargin * diagonal;
  });
}

// Whether all coordinates are whole numbers of voxels, and no round ones, in a volume that goes on
// where these cannot.
bool looksLikeVoxels(const Points& points, const Grid& volume)
{
  const glm::dvec3 last(volume.dimensions - 1);
  const glm::dvec3 ends[2] = { volume.origin, volume.worldFromGrid(last) };
  const glm::dvec3 size = glm::abs(ends[1] - ends[0]);
  const glm::dvec3 below = -glm::min(ends[0], ends[1]);
  const bool goesOn = below.x > 0.25 * size.x && below.y > 0.25 * size.y && below.z > 0.25 * size.z;
  const auto isRound = [](const glm::dvec3& point) {
    return glm::mod(point, RoundMm) == glm::dvec3(0.0);
  };
  return points.size() >= FewestVoxels && goesOn &&
    !std::all_of(points.begin(), points.end(), isRound) &&
    std::all_of(points.begin(), points.end(), [&](const glm::dvec3& point) {
      return point == glm::floor(point) && point == glm::clamp(point, glm::dvec3(0.0), last);
    });
}

std::string doubtAboutSize(const PlaceList& list, const Grid& volume)
{
  const double extent = extentOf(list.points);
  const double diagonal = diagonalOf(volume);
  const double voxel = std::min(
    LargestVoxelMm, glm::max(volume.spacing.x, glm::max(volume.spacing.y, volume.spacing.z)));
  const bool isFar =
    diagonal > 0.0 && (extent > FarthestRatio * diagonal || extent * FarthestRatio < diagonal);
  const std::string is =
    std::string("The ") + list.name + " are within " + threeDigits(extent) + " mm";
  if (list.points.size() > 1 && extent <= ClosestMm)
  {
    return is + "; check that they are in mm";
  }
  if (list.points.size() > 1 && isFar)
  {
    return is + ", and the volume's diagonal has " + threeDigits(diagonal) +
      " mm; check that they are in mm";
  }
  if (list.isInFrame && diagonal > 0.0 && list.points.size() >= FewestVoxels && extent <= voxel)
  {
    return is + ", which is one voxel; check that they are in mm";
  }
  return {};
}

std::string doubtAboutFrame(const PlaceList& list, const Grid& volume)
{
  const std::string the = std::string("The ") + list.name;
  Points all = list.points;
  all.insert(all.end(), list.ends.begin(), list.ends.end());
  if (looksLikeCm(all, volume))
  {
    return the + " are within " + threeDigits(extentOf(all)) +
      " mm at the origin of the world; check that they are in mm, not in cm";
  }
  if (looksLikeVoxels(list.points, volume))
  {
    return the + " have whole numbers from 0 on only, as voxels have; check that they are in mm";
  }
  const double limit = glm::clamp(0.5 * diagonalOf(volume), NearOutsideMm, FarOutsideMm);
  double farthest = 0.0;
  std::size_t count = 0;
  for (const glm::dvec3& point : all)
  {
    const double away = outside(volume, point);
    farthest = std::max(farthest, away);
    count += away > limit ? 1 : 0;
  }
  return count == 0 ? std::string()
                    : the + " are up to " + threeDigits(farthest) +
      " mm outside the volume; check that they are in mm and in the volume's frame";
}
}

std::string threeDigits(double number)
{
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g", number);
  return text.data();
}

double extentOf(const Points& points)
{
  glm::dvec3 least(std::numeric_limits<double>::max());
  glm::dvec3 most(std::numeric_limits<double>::lowest());
  for (const glm::dvec3& point : points)
  {
    least = glm::min(least, point);
    most = glm::max(most, point);
  }
  return points.empty() ? 0.0 : glm::distance(least, most);
}

std::vector<std::string> placeDoubts(const Measurements& measured, const Grid& volume)
{
  std::vector<PlaceList> lists{ { "landmarks at rest", {} },
    { "measured landmarks", {}, bendsOnly(measured) }, { "traced points", measured.traces },
    { "pulls", {} }, { "pins", measured.pins } };
  for (const PointPair& pair : measured.landmarks)
  {
    if (isOn(pair))
    {
      lists[0].points.push_back(pair.rest);
      lists[1].points.push_back(pair.measured);
    }
  }
  for (const PointPair& pull : measured.pulls)
  {
    if (isOn(pull))
    {
      lists[3].points.push_back(pull.rest);
      lists[3].ends.push_back(pull.measured);
    }
  }
  std::vector<std::string> sentences;
  for (const PlaceList& list : lists)
  {
    std::string doubt = doubtAboutSize(list, volume);
    if (doubt.empty() && list.isInFrame && volume.count() > 0)
    {
      doubt = doubtAboutFrame(list, volume);
    }
    const bool isSecond = &list == &lists[1] && !sentences.empty(); // of two lists in one unit
    if (!doubt.empty() && !isSecond)
    {
      sentences.push_back(doubt);
    }
  }
  return sentences;
}
}

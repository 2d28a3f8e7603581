// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Pointer/TrackerRegistration.h"

#include "Filters/Fit/OpenRotation.h"
#include "Filters/Fit/PairDoubts.h"
#include "Interaction/Commands/Application.h"

#include <limits>

namespace brainshift
{
namespace
{
constexpr std::size_t LeastPairs = 3;
constexpr double LeastSpreadMm =
  3.0; // from a line; closer points leave the rotation around it undetermined
constexpr double TouchDeviationMm = 0.7;    // of a touched landmark, along each axis
constexpr double LargestOpenRadians = 0.05; // 3 degrees
constexpr double Unknown = std::numeric_limits<double>::quiet_NaN();

// What to check about a registration that has a result, in one sentence; or nothing.
QString doubtAbout(const std::vector<glm::dvec3>& tracker, const std::vector<glm::dvec3>& image,
  const std::vector<double>& weights)
{
  if (!betterAxes(image, tracker, weights, /*isAnyRotation*/ true).empty())
  {
    return tr(
      "The points fit a mirror image far better: check their order and the axes of the tracker.");
  }
  const OpenRotation open = openRotationOf(image, weights, TouchDeviationMm, LargestOpenRadians);
  return open.isAboutLine()
    ? tr(
        "The points are near to one line: the rotation around it may be off by %1°. Touch one that "
        "is farther beside it.")
        .arg(glm::degrees(open.deviations.x), 0, 'f', 0)
    : QString();
}
}

void TrackerRegistration::touch(const glm::dvec3& tracker)
{
  this->Pairs.push_back({ tracker, std::nullopt, Unknown });
  this->solve();
}

void TrackerRegistration::mark(int row, const glm::dvec3& image)
{
  if (row >= 0 && row < static_cast<int>(this->Pairs.size()))
  {
    this->Pairs[row].image = image;
    this->solve();
  }
}

void TrackerRegistration::remove(int row)
{
  if (row >= 0 && row < static_cast<int>(this->Pairs.size()))
  {
    this->Pairs.erase(this->Pairs.begin() + row);
    this->solve();
  }
}

void TrackerRegistration::take(const RigidPose& imageFromTracker)
{
  this->Pairs.clear();
  this->Solved = imageFromTracker;
  this->Registered = true;
  this->Error = Unknown;
  this->Problem.clear();
  this->Doubt.clear();
}

void TrackerRegistration::solve()
{
  this->Solved = {};
  this->Registered = false;
  this->Error = Unknown;
  this->Problem.clear();
  this->Doubt.clear();
  std::vector<glm::dvec3> tracker;
  std::vector<glm::dvec3> image;
  for (Pair& pair : this->Pairs)
  {
    pair.residual = Unknown;
    if (pair.image)
    {
      tracker.push_back(pair.tracker);
      image.push_back(*pair.image);
    }
  }
  const std::vector<double> weights(tracker.size(), 1.0);
  if (tracker.size() < LeastPairs)
  {
    this->Problem = this->Pairs.empty()
      ? QString()
      : tr("The registration needs %1 pairs; %2 are given.").arg(LeastPairs).arg(tracker.size());
    return;
  }
  if (std::min(spreadAroundLine(tracker, weights), spreadAroundLine(image, weights)) <
    LeastSpreadMm)
  {
    this->Problem = tr("The points are on one line. Touch a point that is not on this line.");
    return;
  }
  const glm::dmat3 rotation = nearestRotation(tracker, image, weights);
  this->Solved = { rotation,
    weightedMean(image, weights) - rotation * weightedMean(tracker, weights) };
  this->Registered = true;
  double squares = 0.0;
  for (Pair& pair : this->Pairs)
  {
    if (pair.image)
    {
      pair.residual = glm::distance(this->Solved.apply(pair.tracker), *pair.image);
      squares += pair.residual * pair.residual;
    }
  }
  this->Error = std::sqrt(squares / static_cast<double>(tracker.size()));
  this->Doubt = doubtAbout(tracker, image, weights);
}
}

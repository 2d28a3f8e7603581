// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Landmarks/Landmarks.h"

#include "Common/Numbers.h"
#include "Formats/Files/Text.h"
#include "Formats/Landmarks/PlainText.h"

#include <cmath>
#include <utility>

namespace brainshift
{
std::string axesFrom(const std::string& word, FileAxes& axes)
{
  const std::string lower = lowerCase(trimmed(word));
  if (lower == "ras" || lower == "0")
  {
    axes = FileAxes::RAS;
    return {};
  }
  if (lower == "lps" || lower == "1")
  {
    axes = FileAxes::LPS;
    return {};
  }
  return "names the coordinate system " + shownWords(word) + "; it must be RAS (0) or LPS (1)";
}

std::string addLandmark(LandmarkList& list, Landmark point, const std::string& where)
{
  if (list.points.size() == MostLandmarks)
  {
    return "has more than " + std::to_string(MostLandmarks) + " points";
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!(std::abs(point.position[axis]) <= FarthestLandmark))
    {
      return "has a coordinate of " + numberText(point.position[axis]) + " mm in " + where +
        "; the limit is " + numberText(FarthestLandmark) + " mm";
    }
  }
  list.points.push_back(std::move(point));
  return {};
}

std::string problemAt(const std::string& where, const std::string& problem)
{
  return "has a " + where + " that " + problem;
}

void noteSkipped(LandmarkList& list, std::size_t skipped)
{
  if (skipped > 0)
  {
    list.notes.push_back("has " + std::to_string(skipped) + (skipped == 1 ? " point" : " points") +
      " without a position, left out");
  }
}
}

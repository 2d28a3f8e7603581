// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Fields/FieldGap.h"

#include "Common/Numbers.h"

#include <cmath>
#include <limits>

namespace brainshift
{
namespace
{
bool isFinite(const glm::vec3& displacement)
{
  return std::isfinite(displacement.x) && std::isfinite(displacement.y) &&
    std::isfinite(displacement.z);
}

std::string placeText(const glm::dvec3& place)
{
  return roundedText(place.x + 0.0) + " " + roundedText(place.y + 0.0) + " " +
    roundedText(place.z + 0.0); // never -0
}
}

std::string gapIn(const Grid& grid, const std::vector<glm::vec3>& displacements)
{
  glm::dvec3 least(std::numeric_limits<double>::max());
  glm::dvec3 most(std::numeric_limits<double>::lowest());
  std::size_t count = 0;
  std::size_t point = 0;
  forEachIndex(glm::ivec3(0), grid.dimensions - 1, [&](const glm::ivec3& index) {
    if (!isFinite(displacements[point++]))
    {
      const glm::dvec3 place = grid.worldFromGrid(glm::dvec3(index));
      least = glm::min(least, place);
      most = glm::max(most, place);
      ++count;
    }
  });
  return count == 0 ? std::string()
                    : "no finite number at " + std::to_string(count) + " of " +
      std::to_string(displacements.size()) + " points, from " + placeText(least) + " to " +
      placeText(most) + " mm";
}

void closeGap(std::vector<glm::vec3>& displacements)
{
  for (glm::vec3& displacement : displacements)
  {
    displacement = isFinite(displacement) ? displacement : glm::vec3(0.0f);
  }
}
}

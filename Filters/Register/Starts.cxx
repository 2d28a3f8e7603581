// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Register/Starts.h"

#include <glm/glm.hpp>

#include <random>

namespace brainshift
{
namespace
{
// A vector evenly within a ball of radius 1.
glm::dvec3 randomInBall(std::mt19937& random)
{
  // The numbers of the generator are the same everywhere; those of std's distributions are not.
  const auto number = [&] {
    return 2.0 * static_cast<double>(random()) / static_cast<double>(std::mt19937::max()) - 1.0;
  };
  glm::dvec3 vector;
  do
  {
    vector.x = number();
    vector.y = number();
    vector.z = number();
  } while (glm::dot(vector, vector) > 1.0);
  return vector;
}
}

StartMotion startMotion(int number, double farthestMm, double farthestDegrees)
{
  StartMotion motion;
  if (number > 0)
  {
    std::mt19937 random(static_cast<std::mt19937::result_type>(number));
    motion.shift = farthestMm * randomInBall(random);
    motion.rotation = glm::radians(farthestDegrees) * randomInBall(random);
  }
  return motion;
}
}

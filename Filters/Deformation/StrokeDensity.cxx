// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Deformation/StrokeDensity.h"

#include <glm/common.hpp>

#include <algorithm>
#include <sstream>

namespace brainshift
{
namespace
{
constexpr int MostNamed = 3;
constexpr double Rounding = 1e-6; // of spacings that went through text

// How finely a stroke bends, mm; 0 if it takes whatever the lattice has.
double finestRadius(const Stroke& stroke)
{
  // Move: the spacing it was made at.
  return stroke.tool == Tool::Stamp ? std::min(stroke.major, stroke.minor) : stroke.major;
}
}

std::string strokesTooFine(const std::vector<Stroke>& strokes, const Grid& lattice)
{
  const double spacing = std::max({ lattice.spacing.x, lattice.spacing.y, lattice.spacing.z });
  std::ostringstream named;
  int count = 0;
  for (std::size_t number = 0; number < strokes.size(); ++number)
  {
    const double radius = finestRadius(strokes[number]);
    if (!strokes[number].enabled || radius <= 0.0 || radius >= spacing * (1.0 - Rounding))
    {
      continue;
    }
    if (count < MostNamed)
    {
      named << (count ? ", " : "") << number << " (" << radius << " mm)";
    }
    ++count;
  }
  if (count == 0)
  {
    return {};
  }
  if (count > MostNamed)
  {
    named << " and " << count - MostNamed << " more";
  }
  std::ostringstream sentence;
  sentence << "The lattice is too coarse for the radius of stroke " << named.str()
           << ": its spacing is " << spacing << " mm. Make LatticeDimensions larger";
  return sentence.str();
}
}

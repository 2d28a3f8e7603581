// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A pair of landmarks as a view marks it.
#ifndef BrainShift_LandmarkMark_h
#define BrainShift_LandmarkMark_h

#include <glm/vec3.hpp>

#include <optional>
#include <string>

namespace brainshift
{
/** Positions: mm, world axes. What is missing is not drawn. */
struct LandmarkMark
{
  enum class Style
  {
    Usual,
    Worst, ///< fits worst: larger, with an exclamation mark
    Off,   ///< switched off: grey
  };

  std::optional<glm::dvec3> tissue;   ///< where its tissue is drawn: a ring
  std::optional<glm::dvec3> measured; ///< where it was measured: a cross
  std::optional<glm::dvec3> fitted;   ///< where the fit puts it: a line from the cross leads there
  std::string text;                   ///< its number
  Style style = Style::Usual;

  bool operator==(const LandmarkMark& other) const
  {
    return this->tissue == other.tissue && this->measured == other.measured &&
      this->fitted == other.fitted && this->text == other.text && this->style == other.style;
  }
};
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief The two colours in which a volume and its reference are compared.
 */
#ifndef BrainShift_ComparisonColors_h
#define BrainShift_ComparisonColors_h

#include <glm/vec3.hpp>

namespace brainshift
{
/// Pairs of colours, numbered as the property ComparisonColors.
enum class ComparisonColors
{
  RedGreen = 0,   ///< Agreement is yellow. Many colour-blind people see one colour.
  BlueOrange = 1, ///< Agreement is grey. All colour-blind people see two colours.
};

/// Red, green and blue, 0 to 1.
struct ColorPair
{
  glm::vec3 own{ 1.0f, 0.0f, 0.0f };       ///< Of the volume.
  glm::vec3 reference{ 0.0f, 1.0f, 0.0f }; ///< Of the reference.
};

/// The colours of a pair. No component of their sum is above 1.
constexpr ColorPair colorPair(ComparisonColors colors)
{
  return colors == ComparisonColors::BlueOrange
    ? ColorPair{ { 0.0f, 0.5f, 1.0f }, { 1.0f, 0.5f, 0.0f } }
    : ColorPair{};
}
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The colours in which pictures show a reference, the uncertainty of tissue, and a tumour.
#ifndef BrainShift_Tints_h
#define BrainShift_Tints_h

#include <glm/glm.hpp>

namespace brainshift
{
// The classes in which pictures show the uncertainty of the position of tissue (one standard
// deviation, mm).
//
// They count one standard deviation along an axis. The tints are of Okabe and Ito's palette, which
// people of all kinds of colour vision tell apart.

/// mm. Below the first, tissue is drawn as it is; from the last on, nothing is known.
constexpr glm::vec3 EvidenceLimits(1.0f, 2.0f, 4.0f);

/// A column for each class but the first: sky blue, orange, reddish purple.
constexpr glm::mat3 EvidenceTints(0.34f, 0.71f, 0.91f, 0.90f, 0.62f, 0.00f, 0.80f, 0.47f, 0.65f);

constexpr double EvidenceStripeMm = 6.0; ///< From one stripe to the next.

// The tumour of a resection, as the report draws it; of the same palette.
constexpr glm::vec3 LeftTumourTint(0.84f, 0.37f, 0.00f);    ///< Vermilion.
constexpr glm::vec3 RemovedTumourTint(0.34f, 0.71f, 0.91f); ///< Sky blue: removed tissue is dark.

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

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief The classes in which pictures show how far the place of tissue can be believed.
 *
 * They count one standard deviation along an axis. The tints are of Okabe and Ito's palette, which
 * people of all kinds of colour vision tell apart.
 */
#ifndef BrainShift_EvidenceClasses_h
#define BrainShift_EvidenceClasses_h

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace brainshift
{
/// mm. Below the first, tissue is drawn as it is; from the last on, nothing is known.
constexpr glm::vec3 EvidenceLimits(1.0f, 2.0f, 4.0f);

/// A column for each class but the first: sky blue, orange, reddish purple.
constexpr glm::mat3 EvidenceTints(0.34f, 0.71f, 0.91f, 0.90f, 0.62f, 0.00f, 0.80f, 0.47f, 0.65f);

constexpr double EvidenceStripeMm = 6.0; ///< From one stripe to the next.
}

#endif

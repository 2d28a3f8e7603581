// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Says which landmark at rest is which measured one.
 */
#ifndef BrainShift_LandmarkMatch_h
#define BrainShift_LandmarkMatch_h

#include "Common/Export.h"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace brainshift
{
/** Pairs of numbers, at rest and measured, in the order at rest; and who has no partner. */
struct LandmarkMatch
{
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  std::vector<std::string> unmatched; ///< "landmark tip at rest", "measured landmark 4"
};

/**
 * Matches by label if a label stands in both lists, else by order. Labels that occur several times
 * match in their order. Landmarks without a label match nothing if the others match by label.
 *
 * @param rest, measured   the labels, empty where a landmark has none
 */
BRAINSHIFT_DEFORMATION_EXPORT LandmarkMatch matchLandmarks(
  const std::vector<std::string>& rest, const std::vector<std::string>& measured);
}

#endif

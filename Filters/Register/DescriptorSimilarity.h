// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Compares the self-similarity context of two volumes: mean squared difference.
 */
#ifndef BrainShift_DescriptorSimilarity_h
#define BrainShift_DescriptorSimilarity_h

#include "Common/Export.h"
#include "Filters/Register/LevelSamples.h"

#include <glm/vec3.hpp>

#include <vector>

namespace brainshift
{
class BRAINSHIFT_DEFORMATION_EXPORT DescriptorSimilarity
{
public:
  /** For each point of a level: four times 12 numbers while it is made, and weights. */
  static constexpr double BytesPerPoint = 208.0;

  DescriptorSimilarity(const LevelVolumes& level, const Lattice& lattice);

  Agreement compare(const std::vector<glm::vec3>& displacements) const;

private:
  LevelSamples Samples;
  std::vector<float> Rest;      // at the samples
  std::vector<float> Reference; // at the points
};
}

#endif

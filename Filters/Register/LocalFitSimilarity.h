// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Explains the reference in small windows by the volume, and by its slope for ultrasound.
 *
 * In each window the reference is fitted by a p + c, or by a p + b g + c, where p is the volume and
 * g the length of its gradient. The disagreement of a window is the share of the reference's
 * variance that the fit leaves. With p alone it is 1 minus the squared local correlation; with both
 * it is 1 minus LC2 (Fuerst et al., Medical Image Analysis 18, 2014).
 */
#ifndef BrainShift_LocalFitSimilarity_h
#define BrainShift_LocalFitSimilarity_h

#include "Filters/Deformation/Export.h"
#include "Filters/Register/LevelSamples.h"

#include <glm/vec3.hpp>

#include <vector>

namespace brainshift
{
class BRAINSHIFT_DEFORMATION_EXPORT LocalFitSimilarity
{
public:
  /** For each point of a level: ten sums, the sample as it is read, and weights. */
  static constexpr double BytesPerPoint = 100.0;

  static constexpr int WindowRadius = 3; ///< points

  LocalFitSimilarity(const LevelVolumes& level, const Lattice& lattice, bool withSlope);

  Agreement compare(const std::vector<glm::vec3>& displacements) const;

private:
  struct Work;
  void takeSamples(const std::vector<glm::vec3>& displacements, Work& work) const;
  void fitWindows(Work& work) const;
  void fitWindow(Work& work, std::size_t number, double& sum, double& count) const;
  ControlForces takeForces(const std::vector<glm::vec3>& displacements, const Work& work) const;

  bool WithSlope;
  LevelSamples Samples;
  std::vector<float> Rest;  // at the samples, 0 to 1
  std::vector<float> Slope; // the same of its gradient's length; empty without
  Volume Reference;         // at the points, 0 to 1
  std::vector<char> Says;   // 1: the volume varies in the window around the sample
  float LeastVariance;      // of the reference, below which a window says little
};
}

#endif

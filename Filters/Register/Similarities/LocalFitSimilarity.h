// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Explains the reference in small windows by the volume, and by its slope for ultrasound.
 *
 * In each window (Windows.h) the reference is fitted by a p + c, or by a p + b g + c. There p is
 * the volume and g the length of its gradient. The cost of a window is the fraction of the
 * reference's variance that the fit leaves. With p alone it is 1 minus the squared local
 * correlation; with both it is 1 minus LC2 (Fuerst et al., Medical Image Analysis 18, 2014).
 */
#ifndef BrainShift_LocalFitSimilarity_h
#define BrainShift_LocalFitSimilarity_h

#include "Filters/Deformation/Export.h"
#include "Filters/Register/Similarity.h"
#include "Filters/Register/Windows.h"

#include <glm/vec3.hpp>

#include <memory>
#include <vector>

namespace brainshift
{
class LocalFitSimilarity : public Comparison
{
public:
  /** For each point of a level: the windows' sums along rows, the sample as read, and weights. */
  static constexpr double BytesPerPoint = 80.0;

  LocalFitSimilarity(LevelVolumes level, const Lattice& lattice, bool withSlope);

  ~LocalFitSimilarity() override;

  CostAndForces compare(const std::vector<glm::vec3>& displacements) override;

private:
  struct Work;
  void leaveOutIdleSamples();
  void takeSample(const LevelSamples::Place& place, float* sums, Work& work) const;
  void takeSamples(const std::vector<glm::vec3>& displacements, Work& work) const;
  void fitWindows(Work& work) const;
  /** Turns the sums of a window into what it leaves; adds to the cost and the windows. */
  void fitWindow(float* numbers, bool counts, double& sum, double& windows) const;
  ControlForces takeForces(const std::vector<glm::vec3>& displacements, const Work& work) const;

  bool WithSlope;
  LevelSamples Samples;
  std::vector<float> Rest;     // at the samples, 0 to 1
  std::vector<float> Slope;    // the same of its gradient's length; empty without
  Volume Reference;            // at the points, 0 to 1
  std::vector<char> Says;      // of the windows; 1: the volume varies there
  float LeastVariance;         // of the reference, below which a window says little
  std::unique_ptr<Work> Known; // of the last comparison; its memory serves the next one
};

/** Explains the reference by the volume; for ultrasound (LC2), also by its slope. */
Metric localFitMetric(bool withSlope);

/** The last level of a refinement of volumes that correlate once they are aligned. */
RefinementLevel localCorrelationAtTheEnd();
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Registers a reference rigidly with a volume, one line of the search at a time.
 *
 * It maximises mutual information (Viola and Wells 1997; Maes et al. 1997), which needs no common
 * contrast. Samples of the volume are read in the reference, off its raster. Directions are
 * searched as by Powell (The Computer Journal 7, 1964, pages 155 to 162), from coarse to fine
 * levels.
 */
#ifndef BrainShift_Alignment_h
#define BrainShift_Alignment_h

#include "Filters/Deformation/Export.h"
#include "Filters/Deformation/Lattice.h"
#include "Filters/Fit/RigidPose.h"
#include "Filters/Register/Volume.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <vector>

namespace brainshift
{
struct AlignmentSettings
{
  std::vector<double> levelsMm{ 8.0, 4.0, 2.0 }; ///< spacing of the samples, coarse to fine
  std::size_t mostSamples = 80000;               ///< on each level
  int mostRounds = 8;                            ///< through all directions, on each level
};

/** What is known after a step. */
struct AlignmentProgress
{
  int level = 0;                   ///< from 0 on, the coarsest
  int steps = 0;                   ///< lines searched, on all levels
  double information = 0.0;        ///< nats; more is better
  double informationAtStart = 0.0; ///< of the reference where it was, on the same level
  double overlap = 0.0;            ///< of the samples, how many lie within the reference
  double done = 0.0; ///< fraction of the most rounds there may be, 0 to 1; 1 once it is finished
  bool isFinished = false;
};

class BRAINSHIFT_DEFORMATION_EXPORT Alignment
{
public:
  /** With a smaller overlap (AlignmentProgress::overlap) nothing is found. */
  static const double LeastOverlap;

  /**
   * @param pair   both where they lie now
   * @param bent   how the volume is bent; null: not at all
   */
  Alignment(RegisteredPair pair, const Lattice* bent, const AlignmentSettings& settings = {});

  /** Searches one line. Nothing once it is finished. */
  const AlignmentProgress& step();

  const AlignmentProgress& progress() const { return this->Progress; }

  /** How to move the reference from where it was: mm, world axes. */
  RigidPose motion() const { return this->motionOf(this->Best); }

  /** How far (mm) the motion moves the middle of what is compared. */
  double shiftMm() const;

  /** Angle of the rotation (degrees). */
  double turnDegrees() const;

  /** Bytes that an alignment takes beside the volumes themselves. */
  static double bytes(const Grid& rest, const Grid& reference);

private:
  // Shift (mm), then rotation about the middle of the samples, in mm at its radius.
  using Parameters = std::array<double, 6>;

  struct Sample
  {
    glm::dvec3 place; // mm, world, as bent
    float value = 0;  // 0 to 1
  };

  void prepareLevel();
  RigidPose motionOf(const Parameters& at) const;
  double loss(const Parameters& at, double* overlap = nullptr) const;
  double searchLine(const Parameters& direction);
  void endRound();
  void finishLevel();
  void tellDone();

  AlignmentSettings Settings;
  Mask Cavity;
  std::vector<Volume> References; // for each level; 0 to 1
  std::vector<std::vector<Sample>> Samples;
  glm::dvec3 Middle{ 0.0 };
  double RadiusMm = 1.0;

  bool IsPrepared = false;
  std::array<Parameters, 6> Directions{};
  Parameters Best{};
  Parameters RoundStart{};
  double Loss = 0.0;
  double RoundStartLoss = 0.0;
  int Line = 0;
  int BestLine = 0;
  double BestGain = 0.0;
  int Rounds = 0;
  AlignmentProgress Progress;
};
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Registers a reference rigidly with a volume, one line of the search at a time.
///
/// It maximises mutual information (Viola and Wells, International Journal of Computer Vision 24,
/// 1997; Maes et al., IEEE Transactions on Medical Imaging 16(2), 1997), which needs no common
/// contrast. Samples of the volume are read in the reference, off its raster. The directions of the
/// search are those of Powell (The Computer Journal 7(2), 1964, pages 155 to 162), from coarse to
/// fine levels.
#ifndef BrainShift_Alignment_h
#define BrainShift_Alignment_h

#include "Filters/Deformation/Lattice.h"
#include "Filters/Fit/RigidPose.h"
#include "Filters/Register/Volume.h"

#include <functional>

namespace brainshift
{
/**
 * Mutual information of two volumes from their joint histogram: pairs of numbers, counted in bins.
 *
 * A pair adds to the four bins nearest to it, by a Parzen window that is the B-spline of first
 * degree. Thévenaz and Unser (IEEE Transactions on Image Processing 9(12), 2000) use B-splines of
 * higher degree in the same way.
 */
class BRAINSHIFT_DEFORMATION_EXPORT JointHistogram
{
public:
  static constexpr int Bins = 32; ///< along each side

  JointHistogram();

  /** Counts a pair. Both numbers: 0 to 1. */
  void add(float a, float b);

  /** Adds the pairs of another histogram. */
  void add(const JointHistogram& other);

  /** Number of pairs that were counted. */
  double count() const { return this->Count; }

  /** Mutual information (nats, 0 or more); 0 without pairs. */
  double information() const;

private:
  std::vector<double> Cells;
  double Count = 0.0;
};

/** A position on a line, and the value there. */
struct LinePoint
{
  double at = 0.0;
  double value = 0.0;
};

/**
 * Brackets a minimum from 0 on with growing steps, then narrows the bracket by parabolas and golden
 * sections, after Brent (Algorithms for Minimization without Derivatives, 1973, chapter 5). The
 * result is never above the value at 0.
 *
 * @param valueAtZero   the function at 0
 * @param stride        the first step, in either direction; above 0
 * @param tolerance     largest distance of the result from the minimum
 */
BRAINSHIFT_DEFORMATION_EXPORT LinePoint lowestAlong(const std::function<double(double)>& function,
  double valueAtZero, double stride, double tolerance);

struct AlignmentSettings
{
  std::vector<double> levelsMm{ 8.0, 4.0, 2.0 }; ///< spacing of the samples, coarse to fine
  std::size_t mostSamples = 80000;               ///< on each level
  int mostRounds = 8; ///< through all directions, on the coarsest level; three times on others
  int starts = 1; ///< positions from which the coarsest level searches; 1 to MostStarts (Starts.h)
  double tolerance = 0.01; ///< of the minimum on a line, as a fraction of the level's spacing
};

/** The figures after a step. */
struct AlignmentProgress
{
  int level = 0;                   ///< from 0 on, the coarsest
  int steps = 0;                   ///< lines searched, on all levels
  double information = 0.0;        ///< nats; more is better
  double informationAtStart = 0.0; ///< of the reference where it was, on the same level
  double overlap = 0.0;            ///< fraction of the samples that have a partner in the reference
  double done = 0.0; ///< fraction of the most rounds there may be, 0 to 1; 1 once it is finished
  bool isFinished = false;
};

class BRAINSHIFT_DEFORMATION_EXPORT Alignment
{
public:
  /** An alignment with a smaller overlap (AlignmentProgress::overlap) is refused. */
  static const double LeastOverlap;

  /**
   * @param pair   both in their present positions
   * @param bent   the deformation of the volume; null: none
   */
  Alignment(
    const RegisteredPair& pair, const Lattice* bent, const AlignmentSettings& settings = {});

  /**
   * Moves the reference to `matrix` x + `shift` (mm, world) before the first step. The matrix is
   * orthogonal; it may mirror.
   */
  void moveReference(const glm::dmat3& matrix, const glm::dvec3& shift);

  /** Mutual information (nats) where the reference is now, on the present level. */
  double information() const { return -this->matched(this->bestKnown().at).loss; }

  /** Searches one line. Nothing once it is finished. */
  const AlignmentProgress& step();

  const AlignmentProgress& progress() const { return this->Progress; }

  /**
   * The motion of the reference from its start: mm, world axes. While the coarsest level searches
   * from several positions, that of the best result so far.
   */
  RigidPose motion() const { return this->motionOf(this->bestKnown().at); }

  /** Distance (mm) by which the motion moves the middle of the samples. */
  double shiftMm() const;

  /** Angle of the rotation (degrees). */
  double rotationDegrees() const;

  /** Bytes that an alignment takes beside the volumes themselves. */
  static double bytes(const Grid& rest, const Grid& reference);

private:
  // Shift (mm), then rotation about the middle of the samples, in mm at its radius.
  using Parameters = std::array<double, 6>;

  struct Sample
  {
    glm::dvec3 position; // mm, world, in the deformed volume
    float value = 0;     // 0 to 1
  };

  // A position, and how well the reference matches there on the present level.
  struct Match
  {
    Parameters at{};
    double loss = 0.0;    // mutual information, negative; 0: the overlap is too small
    double overlap = 0.0; // AlignmentProgress::overlap
  };

  void prepareLevel();
  int mostRoundsHere() const;
  const Match& bestKnown() const;
  RigidPose motionOf(const Parameters& at) const;
  Match matched(const Parameters& at) const;
  double searchLine(const Parameters& direction);
  void endRound();
  void finishLevel();
  bool takeNextStart();
  void report();
  void reportDone();

  AlignmentSettings Settings;
  std::vector<Mask> Missing;      // of the reference: cavity, unknown voxels; none is empty
  std::vector<Volume> References; // for each level; 0 to 1
  std::vector<std::vector<Sample>> Samples;
  glm::dvec3 Middle{ 0.0 };
  double RadiusMm = 1.0;

  bool IsPrepared = false;
  std::array<Parameters, 6> Directions{};
  Match Best;      // of the present search
  int Start = 0;   // of the coarsest level
  Match BestStart; // the result with the least loss of the starts so far
  Match RoundStart;
  int Line = 0;
  int BestLine = 0;
  double BestGain = 0.0;
  int Rounds = 0;
  AlignmentProgress Progress;
};
}

#endif

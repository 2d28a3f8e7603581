// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Turns the list of strokes into displacements of control points and redoes only what changed.
///
/// With the fold guard each stroke, in order, is applied only as far as nothing folds. The strokes
/// that a lattice is too coarse for are found here, too.
#ifndef BrainShift_Replay_h
#define BrainShift_Replay_h

#include "Filters/Deformation/FoldGuard.h"

#include <functional>

namespace brainshift
{
/** Whether and for which refined field the fold guard works. */
struct Guarding
{
  bool on = false;
  int samples = 4; ///< nodes between two control points of the field that is drawn, 0 to 16

  bool operator==(const Guarding& other) const
  {
    return this->on == other.on && (!this->on || this->samples == other.samples);
  }
};

/**
 * Called with the fraction of a run's strokes that is applied, above 0 and below 1. False ends the
 * run.
 */
using ReplayProgress = std::function<bool(double fraction)>;

/** A checkpoint follows so many strokes, until checkpoints take MostCheckpointBytes. */
constexpr std::size_t StrokesPerCheckpoint = 16;

/** Bytes of checkpoints; above it, every second one is dropped. 800 of 19^3 points fit. */
constexpr std::size_t MostCheckpointBytes = std::size_t(64) << 20;

/**
 * Keeps the result of the last run, and the lattice at checkpoints before it. So changing the last
 * stroke costs one stroke, and taking strokes back costs those since a checkpoint, unguarded.
 */
class BRAINSHIFT_DEFORMATION_EXPORT Replay
{
public:
  /**
   * The base lattice after all strokes, in order. Strokes that the previous call had at the start,
   * too, are not guarded again, and they are applied only from the last checkpoint among them. All
   * strokes after a changed one are guarded and applied anew, because weights depend on where
   * earlier strokes moved tissue: 1 to 8 ms each with the guard and 19^3 control points. If
   * `progress` ends the run, the result is that of the strokes until then; see isWhole.
   */
  const Lattice& run(const Lattice& base, const std::vector<Stroke>& strokes,
    const Guarding& guarding = {}, const ReplayProgress& progress = {});

  /** What the last run returned. */
  const Lattice& result() const { return this->Result; }

  /** Whether the last run came to its last stroke. The next run goes on where it ended. */
  bool isWhole() const { return this->Whole; }

  /** How many strokes the result holds. */
  std::size_t count() const { return this->Strokes.size(); }

  /** How many strokes the last run applied. */
  int applied() const { return this->Applied; }

  /** The fraction of each stroke that was applied, 0 to 1. A disabled stroke has 1. */
  const std::vector<double>& fractions() const { return this->Fractions; }

  /**
   * Displacement (mm) of the tissue at the anchor of each stroke along its vector:
   * achievedDisplacement.
   */
  const std::vector<double>& achieved() const { return this->Achieved; }

  /**
   * One sentence, without a full stop, about the enabled strokes whose anchor a mask holds back: it
   * lies where the mask leaves less than the whole displacement, and the tissue there moved by less
   * than 80 % of the stroke's length. Empty if there are none.
   */
  std::string strokesInFeather() const;

  /** How many cells of the base lattice the guard ignores because the base folds in them. */
  int foldedCells() const { return this->Guarded.on ? this->Guard.foldedCells() : 0; }

private:
  void start(const Lattice& base, const Guarding& guarding);
  bool isFor(const Lattice& base, const Guarding& guarding) const;
  std::size_t goBack(std::size_t same, std::size_t count);
  void apply(const Stroke& stroke, double fraction);
  void applyGuarded(const Stroke& stroke);
  void keepCheckpoint(std::size_t count);

  // The displacements after the first `count` strokes.
  struct Checkpoint
  {
    std::size_t count = 0;
    std::vector<glm::vec3> displacements;
  };

  Lattice Base;
  Guarding Guarded;
  FoldGuard Guard;
  std::vector<Stroke> Strokes;
  std::vector<double> Fractions;
  std::vector<double> Achieved;
  Lattice BeforeLast; // after all strokes but the last
  Lattice Result;     // after all of them
  int Applied = 0;
  bool Whole = true;
  std::vector<Checkpoint> Checkpoints; // in the order of the strokes
  std::size_t PerCheckpoint = StrokesPerCheckpoint;
};

/**
 * One sentence, without a full stop, about the enabled strokes whose radius is below the lattice's
 * spacing. It names the strokes, their radii and the spacing. It is empty if there are none.
 *
 * Few or no control points lie within such a radius. The anchor then moves by a third of the
 * stroke's vector or less (measured with Catmull-Rom and sigma 0.5).
 */
BRAINSHIFT_DEFORMATION_EXPORT std::string strokesTooFine(
  const std::vector<Stroke>& strokes, const Grid& lattice);
}

#endif

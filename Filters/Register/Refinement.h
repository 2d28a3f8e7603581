// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Bends a lattice until a volume agrees with a reference, a part of a step for each call.
 *
 * It begins with the lattice as it is, for example as a hand bent it, on a coarse level, and ends
 * on the finest. A step is that of Gauss and Newton on the control points, at most 1.5 points of
 * its level long and halved until the energy falls. The energy is the disagreement (Similarity.h)
 * plus the stiffness (Stiffness.h) of what differs from the beginning. By ultrasound the volume
 * first moves rigidly, which costs no energy, and then bends from there. Where a step would fold,
 * the volume is made stiffer; if that is not enough, the fold guard shortens the step. A new level
 * begins with the better of the last result and the beginning, so that the result never has more
 * energy than the beginning.
 */
#ifndef BrainShift_Refinement_h
#define BrainShift_Refinement_h

#include "Common/Export.h"
#include "Filters/Deformation/FoldGuard.h"
#include "Filters/Deformation/Lattice.h"
#include "Filters/Register/RegisteredPair.h"
#include "Filters/Register/Similarity.h"
#include "Filters/Register/Stiffness.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace brainshift
{
/** One level of a refinement: what is compared there, and how finely. */
struct RefinementStage
{
  SimilarityKind similarity = SimilarityKind::SelfSimilarity;
  double spacingMm = 2.0; ///< of the samples; larger where the volume is coarser or too large
  /** The level is left out where it begins with more disagreement: it might lead astray. */
  double mostDisagreement = 1.0;
  /** The volume moves as a whole, in up to three times as many steps; else it bends. */
  bool isRigid = false;
};

/** The levels for what a user calls a similarity, from coarse to fine. */
BRAINSHIFT_DEFORMATION_EXPORT std::vector<RefinementStage> stagesOf(SimilarityKind kind);

struct RefinementSettings
{
  std::vector<RefinementStage> stages = stagesOf(SimilarityKind::SelfSimilarity);
  double stiffness = 1.0; ///< factor on the stiffness; above 0
  int mostSteps = 15;     ///< on each level where it bends
  int samples = 4;        ///< nodes between two control points, 0 to 16
  bool guards = true;     ///< whether the fold guard shortens steps
};

/** What is known after a step. */
struct RefinementProgress
{
  int level = 0;                    ///< from 0 on, the coarsest
  int steps = 0;                    ///< on all levels
  double disagreement = 0.0;        ///< of this level; 0: both volumes agree
  double disagreementAtStart = 0.0; ///< of the lattice as it began, on the same level
  double movedMm = 0.0;             ///< largest way of a control point in the last step
  double share = 1.0;               ///< smallest share of a step that the fold guard left
  /**
   * Of the samples at rest, how many have a partner: on the levels of the first similarity. By
   * ultrasound: the share of what the sweep saw that is compared.
   */
  double comparedShare = 0.0;
  double stiffness = 1.0; ///< what was used; larger than asked for where tissue would have folded
  double done = 0.0;      ///< share of the most steps there may be, 0 to 1; 1 once it is finished
  bool isFinished = false;
};

/** A step that is sought: each call tries one length of it. */
struct RefinementTrial
{
  std::vector<glm::vec3> step; ///< mm along the grid's axes
  double lengthMm = 0.0;       ///< of the longest of them
  double share = 0.0;          ///< that is tried next
  int attempts = 0;
  int stiffenings = 0;
};

class BRAINSHIFT_DEFORMATION_EXPORT Refinement
{
public:
  /**
   * @param start   over the volume's box, with its mask
   */
  Refinement(RegisteredPair pair, const Lattice& start, const RefinementSettings& settings);

  /**
   * Tries one length of a step, or prepares a part of the next level, which takes about as long. A
   * step is taken once one of its lengths succeeds. Nothing once it is finished.
   */
  const RefinementProgress& step();

  const RefinementProgress& progress() const { return this->Progress; }

  /** The lattice after the last step. */
  const Lattice& lattice() const { return this->Bent; }

  /** Bytes that a refinement takes beside the volumes themselves. */
  static double bytes(const Grid& rest, const Grid& reference, const Grid& lattice,
    const RefinementSettings& settings);

private:
  const RefinementStage& stage() const;
  bool isUltrasound() const;
  double spacingMmOf(const RefinementStage& stage) const;
  Grid gridOf(const RefinementStage& stage) const;
  void findSwept();
  void prepareLevel();
  /** Whether a level that may be left out is finer than the last one, and agrees well enough. */
  bool isWorthIt(const Agreement& here) const;
  void compareHere();
  void beginLevel();
  void stiffen();
  /** What the stiffness is multiplied with: 1, and more where a sweep saw a part of the volume. */
  double stiffnessFactor() const;
  int mostStepsOfLevel() const;
  double firstStride() const; // of a level
  /** Where a step would lead, as far as the guard lets it. */
  struct Candidate
  {
    Lattice lattice;
    std::vector<glm::vec3> controls; // mm along the grid's axes
    double kept = 1.0;               // share of the step
  };
  enum class Outcome
  {
    Open,     // try again
    Improved, // the level goes on
    Settled   // there is nothing more to gain on this level
  };
  Candidate candidateAt(const std::vector<glm::vec3>& step, double share) const;
  void findStep(RefinementTrial& trial) const;
  Outcome tryStep();
  Outcome tryStep(RefinementTrial& trial);
  /** One rigid step. Where it is too long, nothing moves, and the next one is shorter. */
  Outcome moveRigidly();
  double energyOf(const std::vector<glm::vec3>& controls, const Agreement& agreement) const;
  std::vector<glm::vec3> bendOf(const std::vector<glm::vec3>& controls) const;
  Lattice latticeOf(const std::vector<glm::vec3>& controls) const;
  static std::vector<glm::vec3> controlsOf(const Lattice& lattice);
  void take(const Lattice& lattice, Agreement agreement, double energy);
  void finishLevel();
  void tellDone();

  RegisteredPair Pair;
  RefinementSettings Settings;
  double TissueShare;   // of the volume's voxels
  Mask Swept;           // of an ultrasound reference: what it shows
  double SeenMm3 = 0.0; // of the volume's box, at most
  Lattice Start;
  Lattice Bent;
  FoldGuard Guard;
  Stiffness Stiff;
  std::vector<glm::vec3> StartControls; // mm along the grid's axes, as all controls here
  std::vector<glm::vec3> Unbent;        // what the stiffness counts from: the start, moved rigidly
  std::vector<glm::vec3> Controls;
  LevelVolumes Level; // while it is prepared
  Agreement Here;     // the same
  int PreparedParts = 0;
  bool IsPrepared = false;
  int LevelsDone = 0;
  Similarity Compare;
  double LongestStepMm = 0.0;
  double SamplesAtStart = 0.0; // that were compared on this level
  double PointMm3 = 0.0;       // of a sample of this level
  Agreement Known;             // of Controls
  double Energy = 0.0;
  double Stride = 1.0; // factor on the next step
  std::optional<RefinementTrial> Trying;
  int StepsOfLevel = 0;
  RefinementProgress Progress;
};
}

#endif

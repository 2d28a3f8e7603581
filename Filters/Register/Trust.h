// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How far the result of a registration may be trusted, from checks of itself.
///
/// The checks need no truth, and they can be wrong: the limits come from simulations, and the page
/// of the documentation has the rates of failures found and of false alarms.
#ifndef BrainShift_Trust_h
#define BrainShift_Trust_h

#include "Filters/Register/BlockCheck.h"
#include "Filters/Register/InsideCheck.h"
#include "Filters/Register/Orientations.h"
#include "Filters/Register/ResultCheck.h"

namespace brainshift
{
enum class Trust
{
  Unchecked, ///< it was stopped, or too little was compared
  Good,
  Doubtful, ///< a check failed; look at the result
  Failed    ///< the result is wrong, by several checks or by far
};

/** For scripts and panels: "unchecked", "good", "doubtful", "failed". */
BRAINSHIFT_DEFORMATION_EXPORT const char* nameOf(Trust trust);

struct Verdict
{
  Trust trust = Trust::Unchecked;
  std::vector<std::string> reasons; ///< sentences; empty for a good result

  /** Adds a reason. The trust becomes the given one, if that is worse. */
  void lower(Trust to, const std::string& reason);
};

/** The verdict of the checks of a result. */
BRAINSHIFT_DEFORMATION_EXPORT Verdict verdictOf(
  const CheckFigures& figures, const CheckPlan& limits);

/**
 * Why the match far within the outlines is too weak: a sentence. Empty if it is not.
 *
 * @param gain       InsideCheck::gain
 * @param besideMm   InsideCheck::besideMm
 */
BRAINSHIFT_DEFORMATION_EXPORT std::string insideReason(
  const std::optional<double>& gain, double besideMm);

/**
 * Why a reference is in a wrong orientation: a sentence. Empty if the other one is not clearly
 * better, or if it tells too little itself, as noise does.
 *
 * @param axes   of the volume
 */
BRAINSHIFT_DEFORMATION_EXPORT std::string orientationReason(
  const Orientation& asItIs, const Orientation& other, const glm::dmat3& axes);

/** Which blocks belong elsewhere: a sentence. Empty if there are none. */
BRAINSHIFT_DEFORMATION_EXPORT std::string elsewhereReason(const Elsewhere& blocks);

/** Which blocks did, before the refinement went on from where they belong: a sentence. */
BRAINSHIFT_DEFORMATION_EXPORT std::string broughtReason(const Elsewhere& blocks);

/**
 * Why a result fails that a check found a fault of: a sentence. The result before it had another
 * fault, a place that matches better.
 *
 * @param mm   mean distance of that place, from which the refinement went on
 */
BRAINSHIFT_DEFORMATION_EXPORT std::string movedReason(double mm);

/** All checks of a result, a part of them for each call. */
class BRAINSHIFT_DEFORMATION_EXPORT Verification
{
public:
  /**
   * @param pair     both volumes, the reference in its position
   * @param start    the deformation before the registration, over the volume's box
   * @param result   the deformation after it
   * @param plan     with the metrics and limits of the check. The tissue within the outline
   *                 is not compared, blocks are not searched for, and orientations are not tried,
   *                 if the reference is ultrasound: a fan has too little in common with a head.
   * @param level    Refinement::takeLevel, which saves its preparation; or null
   */
  Verification(RegisteredPair pair, const Lattice& start, const Lattice& result,
    const RefinementPlan& plan, std::unique_ptr<PyramidLevel> level = nullptr);

  /** Bytes that the checks take beside the volumes themselves. */
  static double bytes(
    const Grid& rest, const Grid& reference, const Grid& lattice, const RefinementPlan& plan);

  /** False: it is finished. */
  bool step();

  double done() const; ///< fraction, 0 to 1

  bool isFinished() const { return this->IsFinished; }

  /** Once it is finished. */
  const Verdict& verdict() const { return this->Found; }
  const CheckFigures& figures() const { return this->Check.figures(); }
  Elsewhere elsewhere() const { return this->Blocks ? this->Blocks->elsewhere() : Elsewhere(); }

  /** The motion of each control point that takes blocks where they match; see BlockCheck. */
  Controls motionOfBlocks() const;

  /** Hands the volumes back, once it is finished. */
  RegisteredPair takePair() { return this->Check.takePair(); }

private:
  bool finishCheck();
  bool finishInside();
  void finishBlocks();
  void finishSearch();

  ResultCheck Check;
  CheckPlan Limits;
  bool IsOfHeads; // the reference is no ultrasound
  Lattice Start;
  Lattice Result;
  std::unique_ptr<InsideCheck> Inside;
  std::unique_ptr<BlockCheck> Blocks;
  bool HasInside = false; // its verdict
  std::unique_ptr<OrientationSearch> Search;
  bool IsFinished = false;
  Verdict Found;
};
}

#endif

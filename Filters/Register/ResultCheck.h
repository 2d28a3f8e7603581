// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Checks the result of a registration without knowing the truth.
///
/// What was compared is cut in two along each axis, and each half is registered rigidly from the
/// result. Halves of a right result end near each other. Halves of a wrong result do not, because
/// chance made it. Another metric registers all of it rigidly from the result: a wrong result is a
/// minimum of one metric only. By ultrasound the volume is also registered from some places near
/// the result: a right result costs clearly less than any other place where such a search ends; a
/// wrong one is a minimum among many. And searches around a right result end where it is.
#ifndef BrainShift_ResultCheck_h
#define BrainShift_ResultCheck_h

#include "Filters/Register/PyramidLevel.h"

#include <memory>
#include <utility>

namespace brainshift
{
class RefinementStep;
struct RefinementState;

/**
 * What a check found. A figure is absent if too few samples were compared, or if none of them
 * tells a position, as where one of the volumes is flat.
 */
struct CheckFigures
{
  /** Mean distance (mm) of the ends of two halves, a mean over the axes of the volume. */
  std::optional<double> halvesMm;
  std::optional<double> otherMm; ///< mean distance (mm) by which the other metric moves the result
  /** Fraction by which the best other place costs more; absent if a search found none. */
  std::optional<double> rivalGain{};
  double rivalMm = 0.0;   ///< mean distance of that place
  Controls rivalMotion{}; ///< of each control point, from the result to that place
  /**
   * Root of the mean square distance (mm) from the result to where searches around it end. An end
   * that is 2 mm away or more counts as 2 mm if its search began near, else it is another place.
   */
  std::optional<double> spreadMm{};
};

class BRAINSHIFT_DEFORMATION_EXPORT ResultCheck
{
public:
  /**
   * @param pair     both volumes, the reference in its position
   * @param result   the deformation, over the volume's box
   * @param level    one that is compared like the halves, which saves its preparation; or null
   */
  ResultCheck(RegisteredPair pair, const Lattice& result, const RefinementPlan& plan,
    std::unique_ptr<PyramidLevel> level = nullptr);
  ~ResultCheck();

  /** Compares once, or prepares a part of that. False: it is finished. */
  bool step();

  const CheckFigures& figures() const { return this->Figures; }

  double done() const { return static_cast<double>(this->Run) / Runs; } ///< fraction, 0 to 1

  const RegisteredPair& pair() const { return this->Pair; }

  /** Hands the volumes back, once nothing needs them. */
  RegisteredPair takePair() { return std::move(this->Pair); }

private:
  static constexpr int HalfRuns = 6;                       // two for each axis
  static constexpr int FarRuns = 6;                        // from places near the result
  static constexpr int NearRuns = 3;                       // from places nearer to it
  static constexpr int RivalRuns = 1 + FarRuns + NearRuns; // the first from the result
  static constexpr int OtherRun = HalfRuns + RivalRuns;
  static constexpr int Runs = OtherRun + 1; // the last one is by the other metric

  bool isHalf() const { return this->Run < HalfRuns; }
  bool isByOther() const { return this->Run == OtherRun; }
  RefinementLevel wanted() const;
  void prepare();
  void begin();
  bool isTooCoarse(double samples);
  HalfSpace half() const;
  void weigh(const ControlForces& forces);
  void takeStep();
  void goTo(int run);
  void finishRun();
  void finishHalf(const Controls& found);
  void finishRival();
  void addToSpread(double mm);
  void leaveOut();
  std::optional<double> motionMm(const Controls& a, const Controls& b) const;

  RegisteredPair Pair;
  RefinementPlan Plan;
  ComparedRegion Region;
  Lattice Result;
  CheckFigures Figures;
  glm::dvec3 Middle{ 0.0 };    // of what is compared, mm, world, in the volume at rest
  std::vector<double> Weights; // of the control points, by their samples
  double SumOfHalves = 0.0;    // mm
  int Axes = 0;                // of which both halves were registered
  double SumOfSquares = 0.0;   // mm^2, of the spread
  int Ends = 0;                // that it is of
  double Cost = 0.0;           // of the place that the search finds from the result itself

  int Run = 0;
  int Steps = 0;       // of this run
  RefinementLevel Now; // of this metric, as fine as it needs to be
  std::unique_ptr<PyramidLevel> Level;
  std::unique_ptr<RefinementState> State;
  std::unique_ptr<RefinementStep> Step;
  Controls FirstHalf; // where it ended; empty: it had too few samples
};
}

#endif

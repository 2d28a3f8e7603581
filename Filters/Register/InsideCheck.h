// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Checks whether two volumes also match far within their outlines.
///
/// Outlines may match, and hold a registration in its place, although what they enclose is
/// different. So the cost of the tissue far from the outline is compared with its mean cost some
/// points beside the result, along both directions of each axis. There tissue is alike by chance
/// alone.
#ifndef BrainShift_InsideCheck_h
#define BrainShift_InsideCheck_h

#include "Filters/Register/PyramidLevel.h"

namespace brainshift
{
class BRAINSHIFT_DEFORMATION_EXPORT InsideCheck
{
public:
  /**
   * @param pair     both volumes, the reference in its position; lives longer than the check
   * @param result   the deformation, over the volume's box; lives longer than the check
   * @param level    the metric, and the spacing of its points. It gets finer if there are too few,
   *                 as far as memory should be taken.
   */
  InsideCheck(const RegisteredPair& pair, const Lattice& result, const RefinementLevel& level);

  /** Reads the volumes, or prepares a part, or compares once. False: it is finished. */
  bool step();

  /**
   * Fraction by which the cost is less than beside the result; about 0 where the match is by
   * chance. Absent if there are too few samples, or if a cost is no finite number.
   */
  std::optional<double> gain() const;

  /** How far beside the result (mm) it was compared. */
  double besideMm() const;

private:
  void read();
  bool compare();

  const RegisteredPair& Whole;
  const Lattice& Result;
  RefinementLevel Now;
  RegisteredPair Pair; // on points of that spacing; its mask is far within the tissue
  std::unique_ptr<PyramidLevel> Level;
  std::vector<double> Costs; // as it is, then beside it
  bool IsFiner = false;      // than the level it was made for
  bool IsFinished = false;
};
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Finds whether a reference matches a volume better if it is rotated by right angles, mirrored or
/// moved.
///
/// A search that begins in a wrong orientation ends in some position, and its information does not
/// tell that there is a better one. All 48 orientations along the axes of the volume are compared
/// on a coarse level. A search begins from the best of them. Those that match nearly as well as the
/// reference as it is are searched on a finer level.
#ifndef BrainShift_Orientations_h
#define BrainShift_Orientations_h

#include "Filters/Register/Alignment.h"

#include <array>
#include <memory>
#include <string>

namespace brainshift
{
/** An orientation of the reference, and its mutual information with the volume. */
struct Orientation
{
  glm::dmat3 matrix{ 1.0 };    ///< along the axes of the volume: 0, 1 and -1
  glm::dmat3 placement{ 1.0 }; ///< of the reference: `placement` x + `shift` (mm, world)
  glm::dvec3 shift{ 0.0 };
  double information = 0.0; ///< nats, on the finer level, or on the coarse one while it is tried
  bool isBent = false;      ///< compared with the volume as the result bends it
};

/** All 48 products of right angles and mirrors. The first one changes nothing. */
BRAINSHIFT_DEFORMATION_EXPORT const std::vector<glm::dmat3>& allOrientations();

/**
 * Compares all orientations with the volume as it was before the registration: a wrong result has
 * bent it towards the reference as it is. That one is compared with the result, too.
 */
class BRAINSHIFT_DEFORMATION_EXPORT OrientationSearch
{
public:
  /**
   * @param pair     both in their present positions; lives longer than the search
   * @param start    the deformation before the registration; lives longer than the search
   * @param result   the deformation after it; lives longer than the search
   */
  OrientationSearch(const RegisteredPair& pair, const Lattice& start, const Lattice& result);

  /** Reads one volume or searches from one orientation. False: it is finished. */
  bool step();

  double done() const; ///< fraction, 0 to 1

  /** The reference as it is, and the best other position; once it is finished. */
  const Orientation& asItIs() const { return this->Candidates.front(); }
  const Orientation& bestOther() const { return this->Candidates[1]; }

private:
  using Level = std::array<std::unique_ptr<Alignment>, 2>; // of the start, and of the result

  Level levelOf(const AlignmentSettings& settings) const;
  static Alignment placed(const Orientation& one, const Level& level);
  void read();
  void glance();
  void search(Orientation& one, const Level& level);
  void choose();

  const RegisteredPair& Whole;
  const Lattice& Start;
  const Lattice& Result;
  RegisteredPair Pair;                 // with few voxels
  glm::dvec3 RestMiddle{ 0.0 };        // of the tissue, mm, world
  glm::dvec3 ReferenceMiddle{ 0.0 };   // the same of the reference
  Level Coarse;                        // as they begin, with the reference as it is
  Level Fine;                          // the same, absent where nothing is compared on it
  std::vector<Orientation> Candidates; // the first one is the reference as it is
  std::size_t Tried = 0;
  std::size_t Refined = 0;
};

/** In words what is to be done to a reference: "rotated by 180 degrees about (0, 0, 1)". */
BRAINSHIFT_DEFORMATION_EXPORT std::string orientationText(
  const glm::dmat3& matrix, const glm::dmat3& axes);
}

#endif

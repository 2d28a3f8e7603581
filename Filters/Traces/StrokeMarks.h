// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Tells the beginnings of a list of strokes apart, so that a figure that was measured after some
/// strokes is known again when undo comes back to them; and the curve of that figure.
///
/// A deformable volume that Free-Form Deformation made carries
///
///     FFDStrokeMarks  uint64, one more than there are strokes: number k stands for the deformation
///                     after the first k strokes. Two deformations with the same mark are the same.
#ifndef BrainShift_StrokeMarks_h
#define BrainShift_StrokeMarks_h

#include "Filters/Deformation/Lattice.h"
#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include <cstdint>
#include <unordered_map>

class vtkDataObject;

namespace brainshift
{
/** One mark for each beginning of a list of strokes, from none of them to all. */
using StrokeMarks = std::vector<std::uint64_t>;

/**
 * A mark that depends on another one and on a number. Multiplicative (Fibonacci) hashing: Knuth,
 * The Art of Computer Programming 3, section 6.4.
 */
VTKBRAINSHIFTFILTERS_EXPORT std::uint64_t mixed(std::uint64_t mark, std::uint64_t number);

/** Makes marks. It remembers the part of the mask, which has the most numbers. */
class VTKBRAINSHIFTFILTERS_EXPORT StrokeMarker
{
public:
  /**
   * The marks of a list of strokes.
   *
   * @param start      the lattice before all strokes
   * @param settings   numbers that the deformation depends on besides
   * @param strokes    NumbersPerStroke numbers for each stroke
   */
  StrokeMarks marksOf(
    const Lattice& start, const std::vector<double>& settings, const std::vector<double>& strokes);

private:
  std::shared_ptr<const NodeWeights> Mask;
  std::uint64_t MaskMark = 0;
};

/** Attaches the marks to a data set. */
VTKBRAINSHIFTFILTERS_EXPORT void attachMarks(vtkDataObject* volume, const StrokeMarks& marks);

/** Removes them: the deformation is none that strokes made. */
VTKBRAINSHIFTFILTERS_EXPORT void forgetMarks(vtkDataObject* volume);

/** Reads what attachMarks wrote; empty if there are none. */
VTKBRAINSHIFTFILTERS_EXPORT StrokeMarks readMarks(vtkDataObject* volume);

/**
 * A figure over the strokes, remembered for each deformation. It belongs to the strokes: after undo
 * the later points are gone, redo brings them back, and another stroke in the place of one begins
 * another curve there.
 */
class VTKBRAINSHIFTFILTERS_EXPORT StrokeCurve
{
public:
  /**
   * Notes a figure that was measured after all strokes.
   *
   * @param marks   of the strokes; none: the volume carries none
   * @param how     stands for how it was measured, for example the threshold
   */
  void note(const StrokeMarks& marks, std::uint64_t how, double figure);

  /** The figure after none, one, and so on, to all strokes of the last note. NaN: not measured. */
  const std::vector<double>& values() const { return this->Values; }

private:
  std::unordered_map<std::uint64_t, double> Known;
  std::vector<double> Values;
};
}

#endif

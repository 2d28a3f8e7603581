// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Remembers a figure of each deformation that was measured, and tells how it went over the
 *        strokes.
 */
#ifndef BrainShift_StrokeCurve_h
#define BrainShift_StrokeCurve_h

#include "Filters/Traces/StrokeMarks.h"
#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace brainshift
{
/**
 * A figure over the strokes. It belongs to the strokes: after undo the later points are gone, redo
 * brings them back, and another stroke in the place of one begins another curve there.
 */
class VTKBRAINSHIFTFILTERS_EXPORT StrokeCurve
{
public:
  /**
   * Notes a figure that was measured after all strokes.
   *
   * @param marks   of the strokes (StrokeMarks.h); none: the volume does not say them
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

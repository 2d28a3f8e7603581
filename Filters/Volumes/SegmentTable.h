// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Segments that 3D Slicer names in the header of a .seg.nrrd file.
 *
 * Names such as `Segment0_LabelValue` are Slicer's. A file may have several layers, so that
 * segments may overlap; then each segment has a layer.
 */
#ifndef BrainShift_SegmentTable_h
#define BrainShift_SegmentTable_h

#include "Filters/Attached/LabelTable.h"
#include "Filters/Files/HeaderText.h"

#include <string>
#include <vector>

namespace brainshift
{
/** Segments of a file. */
struct SegmentTable
{
  std::vector<Label> labels;        ///< of the first layer
  std::vector<std::string> leftOut; ///< names of the segments of other layers
  bool isSegmentation() const { return !this->labels.empty() || !this->leftOut.empty(); }
};

/** The segments of a header; none if it has none. A segment without a value or name gets its ID. */
SegmentTable segmentsOf(const HeaderText& text);
}

#endif

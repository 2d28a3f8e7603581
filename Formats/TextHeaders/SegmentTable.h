// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Segments that 3D Slicer names in the header of a .seg.nrrd file.
 *
 * Names such as `Segment0_LabelValue` are Slicer's. A file may have several layers, so that
 * segments may overlap; then each segment has a layer, counted from 0.
 */
#ifndef BrainShift_SegmentTable_h
#define BrainShift_SegmentTable_h

#include "Common/LabelTable.h"
#include "Formats/Files/HeaderText.h"

#include <string>
#include <vector>

namespace brainshift
{
/** One segment of a file. */
struct Segment
{
  Label label; ///< in its layer
  int layer = 0;
};

/**
 * The segments of a header; none if it has none. A segment without a name gets its ID as the name.
 */
std::vector<Segment> segmentsOf(const HeaderText& text);

/** The labels of one layer. */
std::vector<Label> labelsIn(const std::vector<Segment>& segments, int layer);

/** The first names of segments in or outside a layer, as a message may show them. */
std::string namesIn(const std::vector<Segment>& segments, int layer);
std::string namesOutside(const std::vector<Segment>& segments, int layer);
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Writes labels as one DICOM segmentation (BINARY) in the patient's study.
#ifndef BrainShift_DerivedSegments_h
#define BrainShift_DerivedSegments_h

#include "Common/LabelTable.h"
#include "Formats/Volumes/OutgoingVolume.h"
#include "Formats/Volumes/VolumeFile.h"

namespace brainshift
{
/** Whether a name ends as that of a segmentation: .seg.dcm. */
bool isSegmentationName(const std::string& fileName);

/** What a segmentation is made of. */
struct OutgoingSegments
{
  OutgoingVolume volume;     ///< whole numbers from 0, which is no segment, to 65535
  std::vector<Label> labels; ///< names, colours and coded terms; values without one get a number
};

/**
 * Writes the file whole or not at all. Frames are in the planes of the scan's images, one for each
 * slice that a segment has, and refer to the image there. Segments are numbered from 1 on, as the
 * standard wants: `warning` says so if the labels were others. Throws one sentence, without a full
 * stop.
 *
 * @param like   a DICOM file of the patient's scan, or a folder with one. The segmentation takes
 *               its patient, study and frame of reference
 */
void writeSegments(const std::string& fileName, const std::string& like,
  const OutgoingSegments& segments, const Progress& progress, std::string& warning);
}

#endif

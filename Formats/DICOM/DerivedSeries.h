// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Writes a volume as a DICOM series of its own: one file for each slice, in a new folder.
#ifndef BrainShift_DerivedSeries_h
#define BrainShift_DerivedSeries_h

#include "Formats/Volumes/OutgoingVolume.h"
#include "Formats/Volumes/VolumeFile.h"

namespace brainshift
{
/**
 * Writes the folder whole or not at all. It must not hold anything yet: slices of two series in one
 * folder are easily taken for one. Throws one sentence, without a full stop.
 *
 * @param folder   .dcm at the end of its name is left out
 * @param like     a DICOM file of the patient's scan, or a folder with one. The series takes its
 *                 patient, study, frame of reference and modality
 */
void writeSeries(const std::string& folder, const std::string& like, const OutgoingVolume& volume,
  const Progress& progress);

/** Whether a name ends as that of a series: .dcm. */
bool isSeriesName(const std::string& fileName);
}

#endif

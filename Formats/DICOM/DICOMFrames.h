// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Where the images of one DICOM file lie, when they were made, and how their numbers are rescaled.
#ifndef BrainShift_DICOMFrames_h
#define BrainShift_DICOMFrames_h

#include "Formats/DICOM/DICOMDataSet.h"
#include "Formats/DICOM/DICOMImages.h"

namespace brainshift
{
/** What holds for all frames of a file (Shared Functional Groups Sequence). */
constexpr DICOMTag SharedGroups = 0x52009229;

/** What holds for each of its frames (Per-Frame Functional Groups Sequence). */
constexpr DICOMTag FrameGroups = 0x52009230;

/** Whether the frames of a file are described one by one (enhanced multi-frame files). */
bool describesFrames(const DICOMDataSet& set);

/** Adds the end of a sentence, unless it is there. */
void addNote(std::vector<std::string>& notes, const std::string& note);

/**
 * Reads ImageOrientationPatient into a frame. False if a set has none that counts, with a note if
 * it has one.
 */
bool readOrientation(const DICOMDataSet& set, DICOMFrame& frame, std::vector<std::string>& notes);

/**
 * Reads the frames of a file: one for a slice, all of a multi-frame file. Adds notes of what may be
 * wrong. Throws the end of a sentence if frames cannot be placed; then there is one frame.
 *
 * @param count   frames that the file announces, at least 1
 */
void readDICOMFrames(const DICOMDataSet& set, int count, std::vector<DICOMFrame>& frames,
  std::vector<std::string>& notes);
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Writes a volume into one file.
///
/// | ending        | format    | world in the file | where it says that sides are not known |
/// |---------------|-----------|-------------------|----------------------------------------|
/// | .nii, .nii.gz | NIfTI-1   | RAS               | descrip; sform code 2, no qform        |
/// | .mha, .mhd    | MetaImage | LPS               | Comment                                |
/// | .nrrd         | NRRD      | LPS               | a comment                              |
///
/// A .mhd holds its numbers itself, so that one rename replaces all of it.
#ifndef BrainShift_WrittenVolume_h
#define BrainShift_WrittenVolume_h

#include "Formats/Volumes/OutgoingVolume.h"
#include "Formats/Volumes/VolumeFile.h"

namespace brainshift
{
/**
 * Writes the file whole or not at all: an old file of this name stays as it was after an error, and
 * if `progress` says stop. The ending of the name chooses the format.
 * Throws one sentence, without a full stop.
 */
void writeVolume(
  const std::string& fileName, const OutgoingVolume& volume, const Progress& progress);
}

#endif

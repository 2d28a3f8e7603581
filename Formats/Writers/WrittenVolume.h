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

#include <functional>

namespace brainshift
{
/** The numbers of a volume that may be larger than memory: layers of it, from its first one on. */
struct VolumeLayers
{
  std::size_t count = 1;                                   ///< parts, of some layers each
  std::function<OutgoingVolume(std::size_t number)> bring; ///< called once for each, in order
};

/** Whether a file has all numbers of the first component first, and so no layers. */
bool partsComponents(const std::string& fileName, const OutgoingVolume& volume);

/**
 * Writes the file whole or not at all: an old file of this name stays as it was after an error, and
 * if `progress` says stop. The ending of the name chooses the format.
 * Throws one sentence, without a full stop.
 */
void writeVolume(
  const std::string& fileName, const OutgoingVolume& volume, const Progress& progress);

/** The same in layers. `volume` has the grid of all and any numbers of their type. */
void writeLayers(const std::string& fileName, const OutgoingVolume& volume,
  const VolumeLayers& layers, const Progress& progress);
}

#endif

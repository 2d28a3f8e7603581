// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Surfaces of FreeSurfer, such as lh.pial: triangles, and maps of values, such as
 *        lh.thickness.
 *
 * All numbers are big endian. Points are in tkRAS (ScannerFrame.h), unless the tag useRealRAS says
 * that they are in the scanner's RAS. The geometry of the volume follows the triangles, as text.
 */
#ifndef BrainShift_FreeSurferSurface_h
#define BrainShift_FreeSurferSurface_h

#include "Formats/Surfaces/ScannerFrame.h"
#include "Formats/Surfaces/SurfaceFile.h"

#include <optional>
#include <string>
#include <vector>

namespace brainshift
{
/** Whether a file begins like a surface of triangles. */
bool isFreeSurferSurface(const std::string& fileName);

/** Reads the bytes of a file. Returns the end of a sentence on what is wrong; else empty. */
std::string readFreeSurferSurface(
  const std::vector<char>& bytes, const GivenVolume& given, Surface& surface);

/** Whether bytes begin like a map of values. */
bool beginsLikeFreeSurferValues(const std::vector<char>& bytes);

/** Reads a map of values. Returns the end of a sentence on what is wrong; else empty. */
std::string readFreeSurferValues(const std::vector<char>& bytes, NamedNumbers& numbers);

/**
 * Sets worldFromStored of a surface in tkRAS, and notes it if nobody knows the volume. `own` is the
 * geometry that the file names. Returns one sentence if the given volume cannot be read.
 */
std::string placeByVolume(
  const std::optional<VolumeFrame>& own, const GivenVolume& given, Surface& surface);
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Surfaces in GIFTI files: an array of points, one of triangles, and numbers of the points.
 *
 * Which frame points are in, the first that holds:
 *  1. They are in the scanner's: they stay.
 *  2. A matrix leads to the scanner's space, or else to that of an aligned anatomy: it counts.
 *  3. Their space has a name: they stay.
 *  4. FreeSurfer left the geometry of its volume: they are in tkRAS (ScannerFrame.h).
 *  5. Nobody knows. They stay, and it is noted.
 */
#ifndef BrainShift_GIFTISurface_h
#define BrainShift_GIFTISurface_h

#include "Formats/Surfaces/SurfaceFile.h"

#include <string>
#include <vector>

namespace brainshift
{
/** Reads the text of a file. Returns the end of a sentence on what is wrong; else empty. */
std::string readGIFTISurface(const std::vector<char>& text, Surface& surface);

/**
 * Adds the numbers and labels of a file to a surface, without its points. Arrays with another
 * number of points are left out and noted. Returns the end of a sentence; else empty.
 */
std::string addGIFTINumbers(const std::vector<char>& text, Surface& surface);
}

#endif

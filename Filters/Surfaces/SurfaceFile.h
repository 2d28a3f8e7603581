// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Reads surfaces and tracts of all formats. The first bytes of a file tell which it is.
 */
#ifndef BrainShift_SurfaceFile_h
#define BrainShift_SurfaceFile_h

#include "Filters/Surfaces/FreeSurferSurface.h"
#include "Filters/Surfaces/Surface.h"

#include <string>
#include <vector>

namespace brainshift
{
/** Whether a file begins like a surface of FreeSurfer or a GIFTI file. */
bool isSurfaceFile(const std::string& fileName);

/** Whether a file begins like one of TrackVis or MRtrix. */
bool isTractFile(const std::string& fileName);

/** Files that together are one surface. */
struct SurfaceFiles
{
  std::string fileName;                    ///< the points and triangles
  std::vector<std::string> valueFileNames; ///< numbers of the points: FreeSurfer's maps, or GIFTI
  GivenVolume volume;
};

/**
 * Reads a surface into RAS mm. Returns one sentence, without a full stop, on what is wrong; empty
 * if nothing is, or if it was told to stop: then the surface has no points.
 *
 * @param warnings   gets sentences, without full stops, on what the user must know
 */
std::string readSurfaceFiles(const SurfaceFiles& files, const ShareDone& shareDone,
  Surface& surface, std::vector<std::string>& warnings);

/**
 * Reads streamlines into RAS mm, as readSurfaceFiles does.
 *
 * @param volumeName   for files of TrackVis without vox_to_ras; empty: none
 */
std::string readTractFile(const std::string& fileName, const std::string& volumeName,
  const ShareDone& shareDone, Tracts& tracts, std::vector<std::string>& warnings);
}

#endif

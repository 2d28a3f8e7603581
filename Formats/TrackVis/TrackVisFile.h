// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Streamlines of TrackVis and of Diffusion Toolkit, DIPY and others (.trk).
 *
 * Points are in mm along the axes of a volume, from the corner of its first voxel. The header's
 * vox_to_ras takes them to RAS; its voxel_order names the directions of the axes. Numbers of points
 * (scalars) and of streamlines (properties) keep their names.
 */
#ifndef BrainShift_TrackVisFile_h
#define BrainShift_TrackVisFile_h

#include "Formats/Surfaces/SurfaceFile.h"

#include <string>
#include <vector>

namespace brainshift
{
/** Whether a file begins like one of TrackVis. */
bool isTrackVisFile(const std::string& fileName);

/**
 * Reads the bytes of a file, whose order it may reverse.
 *
 * @param volumeName   of the volume in whose voxels the streamlines were made; only files without
 *                     vox_to_ras need it. Empty: none
 * @return the end of a sentence on what is wrong; empty if nothing is, or if it was told to stop:
 *         then there are no points
 */
std::string readTrackVis(std::vector<char>& bytes, const std::string& volumeName,
  const ShareDone& shareDone, Tracts& tracts);
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Streamlines of MRtrix (.tck): points in the scanner's RAS, mm.
 *
 * A header of lines "key: value" ends with "END". Three numbers for each point follow; three NaN
 * end a streamline, and three infinite numbers end the file.
 */
#ifndef BrainShift_MRtrixFile_h
#define BrainShift_MRtrixFile_h

#include "Formats/Surfaces/SurfaceFile.h"

#include <string>
#include <vector>

namespace brainshift
{
/** Whether a file begins like one of MRtrix. */
bool isMRtrixFile(const std::string& fileName);

/**
 * Reads the bytes of a file, whose order it may reverse. Returns the end of a sentence on what is
 * wrong; empty if nothing is, or if it was told to stop: then there are no points.
 */
std::string readMRtrix(std::vector<char>& bytes, const ShareDone& shareDone, Tracts& tracts);
}

#endif

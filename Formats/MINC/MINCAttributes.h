// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What libminc does not say of a MINC2 file: which attributes its axes lack, in whose place it
/// gives defaults, and along which axes the limits of the image are, which it takes for the first.
#ifndef BrainShift_MINCAttributes_h
#define BrainShift_MINCAttributes_h

#include <string>
#include <vector>

namespace brainshift
{
/**
 * Those of `attributes` that the file does not have for an axis such as "xspace". All of them, if
 * the file cannot be opened.
 */
std::vector<std::string> missingAttributes(
  const std::string& fileName, const std::string& axis, const std::vector<std::string>& attributes);

/**
 * The attribute dimorder of "image" or of a limit such as "image-max": names of axes, such as
 * "time,zspace", the slowest first. Empty without one.
 */
std::string orderOfMINC(const std::string& fileName, const std::string& array);
}

#endif

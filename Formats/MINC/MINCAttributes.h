// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What libminc does not say of a MINC2 file: which attributes its axes lack, in whose place it
/// gives defaults, and words that it has no call for.
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

/** Text of an attribute of "dimensions/xspace", "image/0/image" and so on. Empty without one. */
std::string wordInMINC(
  const std::string& fileName, const std::string& object, const std::string& attribute);
}

#endif

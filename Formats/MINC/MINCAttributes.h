// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which attributes of its axes a MINC2 file lacks. libminc gives defaults in their place, and does
/// not say so.
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
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Names of files for the C++ library. As in VTK, names are UTF-8 on every system, which Windows
/// takes for letters of its language unless it is told.
#ifndef BrainShift_SystemPath_h
#define BrainShift_SystemPath_h

#include <filesystem>
#include <string>

namespace brainshift
{
/** The path of a name in UTF-8. On Windows it may have more than 260 characters. */
std::filesystem::path systemPath(const std::string& utf8);

/** The name in UTF-8 of a path. */
std::string nameOfPath(const std::filesystem::path& path);
}

#endif

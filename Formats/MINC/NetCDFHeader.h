// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The header of a netCDF file, read before the library reads it.
///
/// The library takes memory for whatever number of dimensions, variables or attributes a header
/// announces, and gives zeros for data behind the end of a file.
#ifndef BrainShift_NetCDFHeader_h
#define BrainShift_NetCDFHeader_h

#include <string>

namespace brainshift
{
/**
 * Throws the end of a sentence unless a netCDF file (version 1 or 2) has all bytes that its header
 * announces: those of the header itself, and of the data of each variable.
 */
void requireWholeNetCDF(const std::string& fileName);
}

#endif

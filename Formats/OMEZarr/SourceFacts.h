// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What tells whether a store is made of the same voxels as before: an unfinished one is gone on
/// with only then.
#ifndef BrainShift_SourceFacts_h
#define BrainShift_SourceFacts_h

#include "Formats/OMEZarr/HalvedVoxels.h"

#include <string>

class vtkAlgorithm;
class vtkImageData;

namespace brainshift
{
/**
 * Path, size and time of a file, or of all files of a folder, and what a reader of BrainShift takes
 * of it. Empty if it is not known where the voxels come from.
 *
 * @param producer   of the input
 * @param file       what the user says; empty: the file of the producer, if it is such a reader
 */
std::string sourceFacts(vtkAlgorithm* producer, const std::string& file);

/** The grid, the type and the time of an image. */
std::string gridFacts(const PyramidContent& content, vtkImageData* image);

/** A hash of some voxels. */
std::string hashFacts(int type, const VoxelBox& box);
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Reads transforms in binary files: MATLAB level 4 (ANTs' 0GenericAffine.mat) and HDF5.
 *
 * HDF5 is ParaView's own library. Sizes are compared with the file, and with the memory, before
 * anything is taken.
 */
#ifndef BrainShift_TransformBinary_h
#define BrainShift_TransformBinary_h

#include "Formats/Transforms/TransformRecord.h"

#include <string>
#include <vector>

namespace brainshift
{
/** Reads ITK's records in a MATLAB file. Returns the end of a sentence, after the file's name. */
std::string readMatlabRecords(const std::string& bytes, std::vector<TransformRecord>& records);

/** Whether a file is an HDF5 file. */
bool isHDF5(const std::string& fileName);

/** Reads ITK's records in an HDF5 file. Returns the end of a sentence, after the file's name. */
std::string readHDF5Records(const std::string& fileName, std::vector<TransformRecord>& records);
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Checks a NIfTI file for what vtkNIFTIImageReader assumes of it.
 *
 * VTK 9.3 reads past the end of a table if the data type is unknown, and allocates any size that a
 * damaged header names.
 */
#ifndef BrainShift_NIFTIFileCheck_h
#define BrainShift_NIFTIFileCheck_h

#include "vtkBrainShiftFormatsModule.h" // for the export macro

#include <string>

namespace brainshift
{
/**
 * Whether the file exists and begins like a NIfTI-1 or NIfTI-2 header. Analyze 7.5 does not count,
 * because it does not say which side is left.
 */
VTKBRAINSHIFTFORMATS_EXPORT bool isNIFTIFile(const std::string& fileName);

/**
 * Why a file cannot be read, with the value and its limit: the end of a sentence, after the name of
 * the file. Empty if the header is good. A compressed file can still be truncated.
 */
VTKBRAINSHIFTFORMATS_EXPORT std::string niftiFileProblem(const std::string& fileName);
}

#endif

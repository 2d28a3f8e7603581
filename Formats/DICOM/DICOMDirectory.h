// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Which files may belong to a DICOM series: those of a folder, or of a DICOMDIR.
 */
#ifndef BrainShift_DICOMDirectory_h
#define BrainShift_DICOMDirectory_h

#include "vtkBrainShiftFormatsModule.h" // for the export macro

#include <string>
#include <vector>

namespace brainshift
{
/**
 * Whether a name leads to DICOM: a file that begins so, or a folder with such a file in it or in
 * its subfolders, down to the fourth level. It looks at no more than 1000 files.
 */
VTKBRAINSHIFTFORMATS_EXPORT bool leadsToDICOM(const std::string& path);

/**
 * Files that begin as DICOM does, sorted by name: those that a DICOMDIR lists; those of a folder,
 * or of its subfolders down to the fourth level if it has none; else those beside a file.
 *
 * @param path   absolute
 */
std::vector<std::string> filesBeside(const std::string& path);
}

#endif

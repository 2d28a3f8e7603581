// SPDX-License-Identifier: BSD-3-Clause
// What vtkNIFTIImageReader takes for granted about a file. VTK 9.3 reads past a table's end on an
// unknown data type, and allocates whatever size a damaged header names.
#ifndef BrainShift_NIFTIFileCheck_h
#define BrainShift_NIFTIFileCheck_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include <string>

namespace brainshift
{
// Whether the file is there and begins like a NIfTI-1 or NIfTI-2 header. Analyze 7.5 does not
// count: it does not say which side is left.
VTKBRAINSHIFTFILTERS_EXPORT bool isNIFTIFile(const std::string& fileName);

// One sentence on why a file cannot be read, with the value and its limit; empty if nothing speaks
// against it. A compressed file may still turn out truncated.
VTKBRAINSHIFTFILTERS_EXPORT std::string niftiFileProblem(const std::string& fileName);
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Whom a DICOM file shows. No reader asks for it; only a user does.
 */
#ifndef BrainShift_DICOMPatient_h
#define BrainShift_DICOMPatient_h

#include "vtkBrainShiftFormatsModule.h" // for the export macro

#include <string>

namespace brainshift
{
/** Texts for the eye, as shownTextOf makes them; empty where the file says nothing. */
struct DICOMPatient
{
  std::string name;
  std::string number;
  std::string birthDate; ///< 1970-01-31
  std::string sex;       ///< M, F or O
};

/** Reads the patient's group of a file. All is empty if the file cannot be read. */
VTKBRAINSHIFTFORMATS_EXPORT DICOMPatient readDICOMPatient(const std::string& path);
}

#endif

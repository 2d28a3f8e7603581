// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/DICOM/DICOMPatient.h"

#include "Formats/DICOM/DICOMAttributes.h"
#include "Formats/DICOM/DICOMDataSet.h"

namespace brainshift
{
DICOMPatient readDICOMPatient(const std::string& path)
{
  DICOMBytes bytes(path, DICOMBytes::MostOfHeader);
  DICOMContent content;
  if (!parseDICOM(bytes, content, PatientGroup::Kept))
  {
    return {};
  }
  DICOMPatient patient;
  patient.name = shownTextOf(content.set, 0x00100010);
  patient.number = shownTextOf(content.set, 0x00100020);
  patient.birthDate = dateOf(content.set, 0x00100030);
  patient.sex = shownTextOf(content.set, 0x00100040);
  return patient;
}
}

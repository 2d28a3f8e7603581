// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDICOMPatientReport.h"

#include "Common/Guard.h"
#include "Formats/DICOM/DICOMPatient.h"
#include "Formats/Volumes/vtkVolumeFileReader.h"

#include "vtkAlgorithm.h"
#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkDICOMPatientReport);

vtkDICOMPatientReport::vtkDICOMPatientReport() = default;
vtkDICOMPatientReport::~vtkDICOMPatientReport() = default;

void vtkDICOMPatientReport::SetSource(vtkAlgorithm* source)
{
  this->Source = source;
}

void vtkDICOMPatientReport::Read()
{
  brainshift::guarded(this, [this] {
    auto* reader = vtkVolumeFileReader::SafeDownCast(this->Source);
    const brainshift::DICOMPatient patient =
      brainshift::readDICOMPatient(reader ? reader->GetShownFile() : std::string());
    this->Name = patient.name;
    this->Number = patient.number;
    this->BirthDate = patient.birthDate;
    this->Sex = patient.sex;
  });
}

// The answers are not printed: a printed object may go to a file.
void vtkDICOMPatientReport::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Source: " << this->Source.GetPointer() << "\n";
}

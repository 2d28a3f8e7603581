// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDICOMPatientReport.h"

#include "Common/Guard.h"
#include "Formats/DICOM/DICOMAttributes.h"
#include "Formats/Volumes/vtkVolumeFileReader.h"

#include "vtkAlgorithm.h"
#include "vtkObjectFactory.h"

using namespace brainshift;

vtkStandardNewMacro(vtkDICOMPatientReport);

vtkDICOMPatientReport::vtkDICOMPatientReport() = default;
vtkDICOMPatientReport::~vtkDICOMPatientReport() = default;

void vtkDICOMPatientReport::SetSource(vtkAlgorithm* source)
{
  this->Source = source;
}

void vtkDICOMPatientReport::Read()
{
  guarded(this, [this] {
    auto* reader = vtkVolumeFileReader::SafeDownCast(this->Source);
    DICOMBytes bytes(reader ? reader->GetShownFile() : std::string(), DICOMBytes::MostOfHeader);
    DICOMContent content;
    const bool isRead = parseDICOM(bytes, content, PatientGroup::Kept);
    const DICOMDataSet set = isRead ? content.set : DICOMDataSet();
    this->Name = shownTextOf(set, 0x00100010);
    this->Number = shownTextOf(set, 0x00100020);
    this->BirthDate = dateOf(set, 0x00100030);
    this->Sex = shownTextOf(set, 0x00100040);
  });
}

// The answers are not printed: a printed object may go to a file.
void vtkDICOMPatientReport::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Source: " << this->Source.GetPointer() << "\n";
}

// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDICOMVolumeReader.h"

#include "Filters/DICOM/DICOMDirectory.h"
#include "Filters/DICOM/DICOMVolume.h"

#include "vtkObjectFactory.h"
#include "vtkStringArray.h"

#include <memory>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkDICOMVolumeReader);

vtkDICOMVolumeReader::vtkDICOMVolumeReader()
  : vtkDICOMVolumeReader(std::make_unique<brainshift::DICOMVolume>().release())
{
}

vtkDICOMVolumeReader::vtkDICOMVolumeReader(brainshift::DICOMVolume* volume)
  : vtkVolumeFileReader(std::unique_ptr<brainshift::VolumeFile>(volume))
  , Volume(volume)
{
  this->Volume->setScanProgress([this](double share) {
    this->UpdateProgress(share);
    return !this->GetAbortExecute();
  });
}

vtkDICOMVolumeReader::~vtkDICOMVolumeReader() = default;

void vtkDICOMVolumeReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Series: " << this->Series << "\n";
  os << indent << "ResampleSlices: " << this->ResampleSlices << "\n";
}

int vtkDICOMVolumeReader::CanReadFile(const char* fileName)
{
  return fileName && brainshift::leadsToDICOM(fileName) ? 1 : 0;
}

void vtkDICOMVolumeReader::SetSeries(const char* name)
{
  const std::string series = name ? name : "";
  if (series == this->Series)
  {
    return;
  }
  // ParaView writes the name of the series that is shown into the property. The folder need not be
  // read again for that.
  const std::vector<std::string> names = this->Volume->seriesNames();
  const bool isShown = this->Series.empty() && !names.empty() && names.front() == series;
  this->Series = series;
  this->Volume->setSeries(series);
  if (!isShown)
  {
    this->Modified();
  }
}

void vtkDICOMVolumeReader::SetResampleSlices(bool resample)
{
  if (resample != this->ResampleSlices)
  {
    this->ResampleSlices = resample;
    this->Volume->setResamples(resample);
    this->Modified();
  }
}

std::string vtkDICOMVolumeReader::GetShownFile() const
{
  return this->Volume->firstFile();
}

vtkStringArray* vtkDICOMVolumeReader::GetSeriesList()
{
  this->SeriesList->Initialize();
  for (const std::string& name : this->Volume->seriesNames())
  {
    this->SeriesList->InsertNextValue(name);
  }
  return this->SeriesList;
}

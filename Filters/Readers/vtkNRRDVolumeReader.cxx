// SPDX-License-Identifier: BSD-3-Clause
#include "vtkNRRDVolumeReader.h"

#include "Filters/Fields/FieldFile.h"
#include "Filters/Volumes/TextHeaderVolume.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkNRRDVolumeReader);

vtkNRRDVolumeReader::vtkNRRDVolumeReader()
  : vtkVolumeFileReader(
      std::make_unique<brainshift::TextHeaderVolume>(brainshift::TextFormat::NRRD))
{
}

int vtkNRRDVolumeReader::CanReadFile(const char* fileName)
{
  using namespace brainshift;
  const bool isVolume = fileName && isTextHeaderVolume(fileName, TextFormat::NRRD);
  return isVolume && !isFieldFile(fileName) ? 1 : 0;
}

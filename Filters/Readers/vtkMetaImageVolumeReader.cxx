// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMetaImageVolumeReader.h"

#include "Filters/Fields/FieldFile.h"
#include "Filters/Volumes/TextHeaderVolume.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkMetaImageVolumeReader);

vtkMetaImageVolumeReader::vtkMetaImageVolumeReader()
  : vtkVolumeFileReader(
      std::make_unique<brainshift::TextHeaderVolume>(brainshift::TextFormat::MetaImage))
{
}

int vtkMetaImageVolumeReader::CanReadFile(const char* fileName)
{
  using namespace brainshift;
  const bool isVolume = fileName && isTextHeaderVolume(fileName, TextFormat::MetaImage);
  return isVolume && !isFieldFile(fileName) ? 1 : 0;
}

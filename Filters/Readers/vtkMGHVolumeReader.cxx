// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMGHVolumeReader.h"

#include "Filters/Volumes/MGHVolume.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkMGHVolumeReader);

vtkMGHVolumeReader::vtkMGHVolumeReader()
  : vtkVolumeFileReader(std::make_unique<brainshift::MGHVolume>())
{
}

int vtkMGHVolumeReader::CanReadFile(const char* fileName)
{
  return fileName && brainshift::isMGHFile(fileName) ? 1 : 0;
}

// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMINCVolumeReader.h"

#include "Filters/Volumes/MINCVolume.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkMINCVolumeReader);

vtkMINCVolumeReader::vtkMINCVolumeReader()
  : vtkVolumeFileReader(std::make_unique<brainshift::MINCVolume>())
{
}

int vtkMINCVolumeReader::CanReadFile(const char* fileName)
{
  return fileName && brainshift::isMINCFile(fileName) ? 1 : 0;
}

// SPDX-License-Identifier: BSD-3-Clause
#include "vtkNIFTIVolumeReader.h"

#include "Filters/Files/NIFTIFileCheck.h"
#include "Filters/Volumes/NIFTIVolume.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkNIFTIVolumeReader);

vtkNIFTIVolumeReader::vtkNIFTIVolumeReader()
  : vtkVolumeFileReader(std::make_unique<brainshift::NIFTIVolume>())
{
}

int vtkNIFTIVolumeReader::CanReadFile(const char* fileName)
{
  return fileName && brainshift::isNIFTIFile(fileName) ? 1 : 0;
}

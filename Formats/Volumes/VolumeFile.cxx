// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Volumes/VolumeFile.h"

#include "vtkDataArray.h"

namespace brainshift
{
double VolumeFile::storedBytes(const VolumeHeader& header) const
{
  return static_cast<double>(header.dimensions.x) * header.dimensions.y * header.dimensions.z *
    header.components * vtkDataArray::GetDataTypeSize(header.storedType);
}
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Surfaces/ScannerFrame.h"

#include "Formats/MGH/MGHVolume.h"
#include "Formats/NIFTI/NIFTIHeader.h"
#include "Formats/NIFTI/NIFTIVolume.h"
#include "Formats/Volumes/RasGrid.h"

namespace brainshift
{
namespace
{
VolumeGrid readGrid(VolumeFile& file, const std::string& fileName)
{
  return withBeginning(file.noun() + " " + fileName + " ", [&] {
    VolumeHeader header;
    file.readHeader(fileName, header);
    withBeginning("places nothing: ", [&] { requireAffine(header.worldFromVoxel); });
    if (!header.knowsSides)
    {
      throw Problem("does not say where its voxels lie");
    }
    return VolumeGrid{ header.worldFromVoxel, header.dimensions };
  });
}
}

glm::dmat4 scannerFromSurface(const VolumeFrame& frame)
{
  return glm::dmat4(glm::dvec4(-frame.xRas, 0.0), glm::dvec4(frame.zRas, 0.0),
    glm::dvec4(-frame.yRas, 0.0), glm::dvec4(frame.cRas, 1.0));
}

VolumeGrid readVolumeGrid(const std::string& fileName)
{
  if (isMGHFile(fileName))
  {
    MGHVolume volume;
    return readGrid(volume, fileName);
  }
  if (!isNIFTIFile(fileName))
  {
    throw Problem("Volume " + fileName + " is no FreeSurfer volume (.mgz, .mgh) and no NIfTI file");
  }
  NIFTIVolume volume;
  VolumeGrid grid = readGrid(volume, fileName);
  grid.worldFromVoxel = volume.inFileOrder(grid.worldFromVoxel, grid.dimensions);
  return grid;
}

VolumeFrame frameOf(const VolumeGrid& grid)
{
  const glm::dmat4& world = grid.worldFromVoxel;
  return { glm::normalize(glm::dvec3(world[0])), glm::normalize(glm::dvec3(world[1])),
    glm::normalize(glm::dvec3(world[2])),
    glm::dvec3(world * glm::dvec4(0.5 * glm::dvec3(grid.dimensions), 1.0)) };
}
}

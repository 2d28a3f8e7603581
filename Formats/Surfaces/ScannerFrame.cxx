// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Surfaces/ScannerFrame.h"

#include "Formats/MGH/MGHVolume.h"
#include "Formats/NIFTI/NIFTIFileCheck.h"
#include "Formats/NIFTI/NIFTIVolume.h"
#include "Formats/Volumes/RasGrid.h"
#include "Formats/Volumes/VolumeFile.h"

#include <glm/geometric.hpp>

namespace brainshift
{
namespace
{
std::string readGrid(VolumeFile& file, const std::string& fileName, VolumeGrid& grid)
{
  VolumeHeader header;
  const std::string beginning = file.noun() + " " + fileName + " ";
  std::string problem = file.readHeader(fileName, header);
  if (!problem.empty())
  {
    return beginning + problem;
  }
  problem = affineProblem(header.worldFromVoxel);
  if (!problem.empty())
  {
    return beginning + "places nothing: " + problem;
  }
  grid = { header.worldFromVoxel, header.dimensions };
  return header.knowsSides ? std::string() : beginning + "does not say where its voxels lie";
}
}

glm::dmat4 scannerFromSurface(const VolumeFrame& frame)
{
  return glm::dmat4(glm::dvec4(-frame.xRas, 0.0), glm::dvec4(frame.zRas, 0.0),
    glm::dvec4(-frame.yRas, 0.0), glm::dvec4(frame.cRas, 1.0));
}

std::string readVolumeGrid(const std::string& fileName, VolumeGrid& grid)
{
  if (isMGHFile(fileName))
  {
    MGHVolume volume;
    return readGrid(volume, fileName, grid);
  }
  if (isNIFTIFile(fileName))
  {
    NIFTIVolume volume;
    const std::string problem = readGrid(volume, fileName, grid);
    if (volume.reversesSlices()) // as VTK reads them; the file's own order counts here
    {
      const glm::dvec4 last = grid.worldFromVoxel[2] * (grid.dimensions.z - 1.0);
      grid.worldFromVoxel[3] += last;
      grid.worldFromVoxel[2] = -grid.worldFromVoxel[2];
    }
    return problem;
  }
  return "Volume " + fileName + " is no FreeSurfer volume (.mgz, .mgh) and no NIfTI file";
}

VolumeFrame frameOf(const VolumeGrid& grid)
{
  const glm::dmat4& world = grid.worldFromVoxel;
  return { glm::normalize(glm::dvec3(world[0])), glm::normalize(glm::dvec3(world[1])),
    glm::normalize(glm::dvec3(world[2])),
    glm::dvec3(world * glm::dvec4(0.5 * glm::dvec3(grid.dimensions), 1.0)) };
}
}

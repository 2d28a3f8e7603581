// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// From FreeSurfer's surface frame (tkRAS) to that of the scanner, mm.
///
/// tkRAS has its origin in the middle of a volume and runs along the volume's axes: x against the
/// columns' axis, y along the slices' axis, z against the rows' axis. Which axes the volume has in
/// the scanner's RAS, and where its middle lies, are the volume's geometry.
#ifndef BrainShift_ScannerFrame_h
#define BrainShift_ScannerFrame_h

#include <glm/glm.hpp>

#include <string>

namespace brainshift
{
/** What a user says of the volume from which a surface was made, for files that do not say it. */
struct GivenVolume
{
  std::string fileName;   ///< of the volume; empty: none
  glm::dvec3 cRas{ 0.0 }; ///< its middle (mm, scanner RAS), where there is no file; 0 0 0: none
};

/** The geometry of a volume. The names are FreeSurfer's: unit vectors and mm, scanner RAS. */
struct VolumeFrame
{
  glm::dvec3 xRas{ -1.0, 0.0, 0.0 }; ///< along columns
  glm::dvec3 yRas{ 0.0, 0.0, -1.0 }; ///< along rows
  glm::dvec3 zRas{ 0.0, 1.0, 0.0 };  ///< along slices
  glm::dvec3 cRas{ 0.0 };            ///< the voxel in the middle, at half the sides
};

/** Takes tkRAS to the scanner's RAS. */
glm::dmat4 scannerFromSurface(const VolumeFrame& frame);

/** Where the voxels of a volume lie. */
struct VolumeGrid
{
  glm::dmat4 worldFromVoxel{ 1.0 }; ///< mm, RAS
  glm::ivec3 dimensions{ 0 };
};

/**
 * Where the voxels of a file lie, in its own order: FreeSurfer (.mgz, .mgh) or NIfTI. Throws one
 * sentence, without a full stop.
 */
VolumeGrid readVolumeGrid(const std::string& fileName);

/** The geometry of a volume whose voxels lie so. */
VolumeFrame frameOf(const VolumeGrid& grid);
}

#endif

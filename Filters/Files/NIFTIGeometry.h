// SPDX-License-Identifier: BSD-3-Clause
// Where the voxels of a NIfTI file lie: from the header's numbers to a grid along the RAS axes.
// World is RAS: x to the patient's right, y to the front, z to the head, in mm.
#ifndef BrainShift_NIFTIGeometry_h
#define BrainShift_NIFTIGeometry_h

#include "Filters/Deformation/Grid.h"
#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <string>

namespace brainshift
{
// Two axes of a rotation are perpendicular. Cosines above this are shear: float32 headers stay
// below 1e-6, and 1e-4 moves no voxel of a head by more than 0.03 mm.
constexpr double LargestUnreportedShear = 1e-4;

// The header fields that place voxels, as stored.
struct NIFTIPlacement
{
  int sformCode = 0;                     // above 0: the sform holds
  int qformCode = 0;                     // above 0: the qform holds, unless the sform does
  std::array<glm::dvec4, 3> sformRows{}; // srow_x, srow_y, srow_z
  glm::dvec3 quaternion{ 0.0 };          // quatern_b, quatern_c, quatern_d
  glm::dvec3 qformOffset{ 0.0 };         // qoffset_x, qoffset_y, qoffset_z
  glm::dvec3 pixelSize{ 1.0 };           // pixdim[1] to pixdim[3]
  double qfac = 1.0;                     // pixdim[0]; below 0: the third axis is reversed
  double mmPerUnit = 1.0;                // of all the lengths above
};

// Units of a header's xyzt_units; unknown units count as mm and s.
VTKBRAINSHIFTFILTERS_EXPORT double mmPerNIFTIUnit(int xyztUnits);
VTKBRAINSHIFTFILTERS_EXPORT double secondsPerNIFTIUnit(int xyztUnits);

// World position (mm, RAS) from voxel index in the file. The sform if there is one, else the qform,
// else pixel sizes along RAS axes with voxel (0,0,0) at the origin: the standard's methods 3, 2, 1.
VTKBRAINSHIFTFILTERS_EXPORT glm::dmat4 worldFromVoxel(const NIFTIPlacement& placement);

// One sentence on why an affine cannot place voxels (not finite, singular), or empty.
VTKBRAINSHIFTFILTERS_EXPORT std::string affineProblem(const glm::dmat4& worldFromVoxel);

// A volume's voxels, permuted and flipped so that each grid axis runs along the nearest RAS axis.
struct NIFTIGrid
{
  Grid grid;                               // direction: what rotation is left, often the identity
  std::array<int, 3> voxelAxis{ 0, 1, 2 }; // the voxel axis that runs along each grid axis
  std::array<bool, 3> reversed{};          // whether it runs the other way
  double shear = 0.0;                      // largest cosine between two voxel axes
  double largestErrorMm = 0.0; // how far the grid puts a corner from where the affine does
};

// Loses nothing unless the affine is sheared; then it keeps spacing and centre and takes the
// nearest rotation. `dimensions`: voxels a side, in the file's order. The affine has no
// affineProblem.
VTKBRAINSHIFTFILTERS_EXPORT NIFTIGrid nearestRasGrid(
  const glm::dmat4& worldFromVoxel, const glm::ivec3& dimensions);
}

#endif

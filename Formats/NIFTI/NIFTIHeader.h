// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Headers of NIfTI files: what vtkNIFTIImageReader assumes of them, and where they place voxels.
///
/// VTK 9.3 reads past the end of a table if the data type is unknown, and allocates any size that a
/// damaged header names.
///
/// World is RAS: x to the patient's right, y to the front, z to the head, in mm. Names such as
/// `srow_x` are those of the NIfTI-1 standard (nifti1.h).
#ifndef BrainShift_NIFTIHeader_h
#define BrainShift_NIFTIHeader_h

#include <glm/glm.hpp>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace brainshift
{
/**
 * Whether the file exists and begins like a NIfTI-1 or NIfTI-2 header. Analyze 7.5 does not count,
 * because it does not say which side is left.
 */
bool isNIFTIFile(const std::string& fileName);

/**
 * Throws the end of a sentence, after the name of the file, if its header cannot be read. A
 * compressed file can still be truncated.
 */
void requireNIFTIFile(const std::string& fileName);

/** Bytes of a voxel of a datatype that requireNIFTIFile let pass; 0: unknown. */
int bytesOfNIFTIVoxel(int dataType);

/** The numbers of the header that place voxels, as they are stored. */
struct NIFTIPlacement
{
  glm::ivec3 dimensions{ 1 };            ///< voxels along each axis
  int sformCode = 0;                     ///< above 0: the sform holds
  int qformCode = 0;                     ///< above 0: the qform holds, unless the sform does
  std::array<glm::dvec4, 3> sformRows{}; ///< srow_x, srow_y, srow_z
  glm::dvec3 quaternion{ 0.0 };          ///< quatern_b, quatern_c, quatern_d
  glm::dvec3 qformOffset{ 0.0 };         ///< qoffset_x, qoffset_y, qoffset_z
  glm::dvec3 pixelSize{ 1.0 };           ///< pixdim[1] to pixdim[3]
  double qfac = 1.0;                     ///< pixdim[0]; below 0: the third axis is reversed
  double mmPerUnit = 1.0;                ///< of all the lengths above
};

/** Numbers of a header that say when the volumes of a series are, as they are stored. */
struct NIFTITiming
{
  std::size_t volumes = 1; ///< dim[4]
  double step = 0.0;       ///< pixdim[4]
  double start = 0.0;      ///< toffset
  int xyztUnits = 0;
};

/**
 * Millimetres in the unit of length of a header's xyzt_units. No unit (0) counts as mm; none: the
 * standard does not know the code.
 */
std::optional<double> mmPerNIFTIUnit(int xyztUnits);

/**
 * Times of the volumes, s. `warnings` gets the ends of sentences on numbers that are no times: they
 * do not count.
 */
std::vector<double> timesOf(const NIFTITiming& timing, std::vector<std::string>& warnings);

/** Whether the sform counts: not one of zeros beside a qform. */
bool sformCounts(const NIFTIPlacement& placement);

/**
 * World position (mm, RAS) from a voxel's index in the file: the sform if there is one, else the
 * qform, else pixel sizes along the RAS axes with voxel (0, 0, 0) at the origin. These are methods
 * 3, 2 and 1 of the standard. `warnings` gets the ends of sentences on numbers that contradict each
 * other or do not count.
 */
glm::dmat4 worldFromVoxel(const NIFTIPlacement& placement, std::vector<std::string>& warnings);
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Maps in the millimetres of FSL, and SPM's positions: three numbers at each voxel of a NIfTI
/// file.
///
/// FSL counts mm from the first voxel of an image, along its axes and by its pixdim. x runs
/// backward where the file is right-handed. So its maps depend on the fixed (--ref) and the moving
/// image (--in).
#ifndef BrainShift_FSLWarp_h
#define BrainShift_FSLWarp_h

#include "Formats/Transforms/MatrixText.h"

namespace brainshift
{
/** An image in the millimetres of FSL. */
struct FSLFrame
{
  glm::dmat4 worldFromFSL{ 1.0 };   ///< RAS mm
  glm::dmat4 worldFromVoxel{ 1.0 }; ///< in the file's order
  glm::ivec3 dimensions{ 0 };
  glm::dvec3 sizes{ 1.0 };    ///< of a voxel by pixdim, mm
  bool isRightHanded = false; ///< then x of FSL runs backward
};

/** What an image is wanted for. */
struct FSLNeed
{
  std::string role;  ///< fixed or moving
  std::string thing; ///< what the file holds that needs it
};

/**
 * The frame of a NIfTI file, or throws the end of a sentence. `knowsSides` becomes false if the
 * image does not know them.
 */
FSLFrame readFSLFrame(const FSLNeed& need, const std::string& image, bool& knowsSides);

/** Maps in NIfTI files that name or need more than their own voxels. */
enum class NIFTIWarpKind
{
  Positions, ///< RAS mm in the moving image, as SPM writes them
  FSLField,  ///< intent 2006: displacements or positions in FSL's mm
  FSLSpline, ///< intent 2007: coefficients of cubic B-splines in FSL's mm
};

/**
 * Which map of FSL a file is by its intent; none if it is another field, or no NIfTI file. If the
 * user says that SPM wrote it, a NIfTI file without another program's intent has positions. Throws
 * the end of a sentence.
 */
std::optional<NIFTIWarpKind> niftiWarpOf(const std::string& fileName, bool isOfSPM);

/**
 * Adds the map of a file of FSL, in LPS, or throws the end of a sentence. A field needs the moving
 * image, and is in the voxels of the fixed one. Coefficients need both. Whether a field holds
 * displacements or positions is found by FSL's own rule: what varies less, it holds.
 */
void addFSLWarp(const std::string& fileName, NIFTIWarpKind kind, const NamedImages& images,
  PointTransform& transform);

/** Adds positions in RAS mm, in LPS, likewise. */
void addPositions(const std::string& fileName, PointTransform& transform);
}

#endif

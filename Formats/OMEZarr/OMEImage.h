// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What a zarr group says of an image by OME's rules (NGFF 0.4 and 0.5): its axes, its resolutions
/// and where they lie, its channels and its labels.
#ifndef BrainShift_OMEImage_h
#define BrainShift_OMEImage_h

#include "Common/LabelTable.h"
#include "Formats/OMEZarr/ZarrArray.h"

#include <glm/glm.hpp>

#include <array>

namespace brainshift
{
/** One image of a store. */
struct OMEChoice
{
  std::string name;      ///< for a list
  std::string path;      ///< of its group; empty: the top
  std::size_t index = 0; ///< of its group's multiscales
};

/** One resolution of an image. Scale and translation are in the units of the axes. */
struct OMELevel
{
  ZarrArray array;
  std::vector<double> scale;       ///< along each axis of the array
  std::vector<double> translation; ///< of the middle of the first voxel
  std::string bricks; ///< the array of BrainShift's writer (PyramidPlan.h); empty: not known
};

/** The axes of an image: places in its arrays. */
struct OMEAxes
{
  std::array<int, 3> space{ -1, -1, -1 }; ///< of x, y, z; -1: there is none
  int time = -1;                          ///< -1: there is none
  int channel = -1;                       ///< -1: there is none
  std::vector<double> units;              ///< of each axis: mm in one for space, s in one for time
};

struct OMEImage
{
  OMEAxes axes;
  std::vector<OMELevel> levels;      ///< as the store orders them, the finest first
  std::vector<std::string> channels; ///< names, as many as the store has
  bool isLabelMap = false;
  std::vector<Label> labels;
  /// The axes of the voxels in the world, as columns; places of levels are as if it were 1, and all
  /// levels turn about the first voxel of the finest. Only BrainShift's own metadata say it.
  glm::dmat3 direction{ 1.0 };
  /// RAS from the space of scales and translations, as the orientations of the axes say it.
  glm::dmat3 rasFromAxes{ 1.0 };
  bool knowsSides = false;           ///< whether either says that the world is RAS
  std::vector<std::string> warnings; ///< ends of sentences about the store
};

/** The images of a store, and after each its label images. Throws the end of a sentence if none. */
std::vector<OMEChoice> imagesOf(const ZarrStore& store);

/** Throws the end of a sentence. */
OMEImage readOMEImage(const ZarrStore& store, const OMEChoice& choice);
}

#endif

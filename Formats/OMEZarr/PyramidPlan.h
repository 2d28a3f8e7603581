// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What a written OME-Zarr image is: its levels, and what its metadata say.
///
/// Beside OME's metadata the group has our own, under the key "brainshift": the axes of the world,
/// the direction matrix, which OME-Zarr 0.4 and 0.5 cannot say, and where the least and greatest
/// values of the bricks are. Other programs pass over it.
#ifndef BrainShift_PyramidPlan_h
#define BrainShift_PyramidPlan_h

#include "Common/Grid.h"
#include "Common/LabelTable.h"
#include "Formats/OMEZarr/ZarrJson.h"

#include <array>

namespace brainshift
{
constexpr std::int64_t PyramidChunk = 64; ///< voxels along each side of a chunk, which is a brick

/** The name of the file that a store has until it is finished. */
constexpr const char* UnfinishedMark = "brainshift-unfinished.json";

/** The image of all levels. */
struct PyramidContent
{
  Grid grid;                 ///< mm, RAS, of the finest level
  int type = 0;              ///< VTK's number of the type of a number; integers of up to 4 bytes
  int components = 1;        ///< channels in the store
  bool knowsSides = true;    ///< false: RAS is a guess
  bool isLabelMap = false;   ///< levels have the most frequent label in place of averages
  std::vector<Label> labels; ///< names and colours; may be empty
  bool isVersion3 = false;   ///< NGFF 0.5 on zarr 3; otherwise NGFF 0.4 on zarr 2
  std::vector<std::string> channels; ///< their names; as many as there are components, or none
  std::vector<std::array<double, 2>> ranges; ///< least and greatest number of each of them
};

/** One level. */
struct PyramidLevel
{
  glm::ivec3 size{ 1 }; ///< voxels
  glm::ivec3 step{ 1 }; ///< voxels of the finest level in one of these
};

/**
 * The finest level and those that are made of it. From one to the next, an axis is halved if its
 * voxels are at most 1.5 times as long as the shortest side, until all fits one chunk. Of an odd
 * number of voxels the last is made of those that are there.
 */
std::vector<PyramidLevel> pyramidLevels(const Grid& grid);

/** The name of a metadata file and its text. */
struct PyramidFile
{
  std::string key;
  Json json;
};

/** Of the group: the image, its levels and their places. */
PyramidFile pyramidGroup(const PyramidContent& content, const std::vector<PyramidLevel>& levels);

/** Of the voxels of a level, whose path is its number. */
PyramidFile pyramidArray(
  const PyramidContent& content, const std::vector<PyramidLevel>& levels, std::size_t level);

/**
 * Of the least and greatest values of the bricks of a level (float64): [channel,] brick z, y, x,
 * and least, greatest. NaN where a brick has no number. One chunk, of the fill value NaN.
 */
PyramidFile pyramidBricks(
  const PyramidContent& content, const std::vector<PyramidLevel>& levels, std::size_t level);

/** Chunks along each axis of a level. */
glm::ivec3 chunksOf(const PyramidLevel& level);
}

#endif

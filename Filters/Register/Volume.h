// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Numbers on a grid, and the operations of a pyramid: smooth, resample, shrink a mask.
#ifndef BrainShift_Volume_h
#define BrainShift_Volume_h

#include "Filters/Deformation/MaskWeights.h"

#include <array>

namespace brainshift
{
/** One number for each point of a grid, x fastest. */
struct Volume
{
  Grid grid;
  std::vector<float> values;
};

/** The two volumes of a registration, and the parts of them that count. */
struct RegisteredPair
{
  Volume rest;           ///< the volume as loaded
  Volume reference;      ///< on any grid, at its position in the world
  Mask inside;           ///< of the rest frame: the compared tissue; without voxels: all
  Mask cavity;           ///< tissue that the reference lacks; without voxels: none
  Mask restUnknown;      ///< voxels of the volume that have no value; without voxels: none
  Mask referenceUnknown; ///< the same of the reference
};

/** The eight neighbours of a position in a grid, and their interpolation weights. */
struct Neighbours
{
  bool isInside = false; ///< false: the position is outside the grid; nothing else is set
  std::size_t first = 0; ///< the neighbour with the lowest indices
  std::size_t next[3]{}; ///< steps to the next neighbour along each axis
  glm::vec3 within{ 0 }; ///< 0 to 1 along each axis, from the first neighbour
};

/** The neighbours of a position in grid coordinates. Each axis must have two points or more. */
inline Neighbours neighboursOf(const glm::ivec3& dimensions, const glm::vec3& at)
{
  Neighbours found;
  const glm::vec3 last(dimensions - 1);
  found.isInside = at.x >= 0.0f && at.y >= 0.0f && at.z >= 0.0f && at.x <= last.x &&
    at.y <= last.y && at.z <= last.z;
  if (found.isInside)
  {
    const glm::ivec3 low = glm::min(glm::ivec3(at), dimensions - 2);
    const std::size_t row = dimensions.x;
    const std::size_t slab = row * dimensions.y;
    found.first = low.z * slab + low.y * row + low.x;
    found.next[0] = 1;
    found.next[1] = row;
    found.next[2] = slab;
    found.within = at - glm::vec3(low);
  }
  return found;
}

/** A number and its derivatives for one step of each index. */
struct ValueAndSlope
{
  float value = 0.0f;
  glm::vec3 slope{ 0.0f };
};

/** Trilinear interpolation between the neighbours, with its derivatives. */
inline ValueAndSlope trilinear(const float* values, const Neighbours& at)
{
  const float* v = values + at.first;
  const std::size_t x = at.next[0];
  const std::size_t y = at.next[1];
  const std::size_t z = at.next[2];
  const glm::vec3 t = at.within;
  const float d00 = v[x] - v[0];
  const float d10 = v[x + y] - v[y];
  const float d01 = v[x + z] - v[z];
  const float d11 = v[x + y + z] - v[y + z];
  const float v00 = v[0] + t.x * d00;
  const float v10 = v[y] + t.x * d10;
  const float v01 = v[z] + t.x * d01;
  const float v11 = v[y + z] + t.x * d11;
  const float low = v00 + t.y * (v10 - v00);
  const float high = v01 + t.y * (v11 - v01);
  ValueAndSlope result;
  result.value = low + t.z * (high - low);
  result.slope.x = (1 - t.z) * (d00 + t.y * (d10 - d00)) + t.z * (d01 + t.y * (d11 - d01));
  result.slope.y = (1 - t.z) * (v10 - v00) + t.z * (v11 - v01);
  result.slope.z = high - low;
  return result;
}

/** The grid with neighbours `spacingMm` apart, or as far apart as in the source if that is more. */
BRAINSHIFT_DEFORMATION_EXPORT Grid coarseGrid(const Grid& source, double spacingMm);

/** Volume of the box around one point (mm³). */
inline double pointVolume(const Grid& grid)
{
  return grid.spacing.x * grid.spacing.y * grid.spacing.z;
}

/**
 * The volume as a grid of that spacing may sample it: smoothed by a Gaussian along each axis whose
 * points are nearer than `spacingMm`.
 */
BRAINSHIFT_DEFORMATION_EXPORT Volume smoothed(const Volume& source, double spacingMm);

/** The volume at the points of another grid, trilinear. Outside it the nearest value holds. */
BRAINSHIFT_DEFORMATION_EXPORT Volume resampled(const Volume& source, const Grid& to);

/**
 * resampled(smoothed(source, spacingMm), to), to rounding. Where both grids have the same axes, it
 * smooths for the points of `to` alone, which takes a small part of the time.
 */
BRAINSHIFT_DEFORMATION_EXPORT Volume sampled(
  const Volume& source, double spacingMm, const Grid& to);

/** Adds up the values within so many points along each axis. Beyond the grid they are 0. */
BRAINSHIFT_DEFORMATION_EXPORT void boxSum(Volume& volume, const glm::ivec3& radii);

/** The length of the gradient at each point, for each mm. */
BRAINSHIFT_DEFORMATION_EXPORT std::vector<float> gradientLength(const Volume& volume);

/**
 * How steeply the values rise at each point along a direction (world, of length 1), for each mm; 0
 * where they fall.
 */
BRAINSHIFT_DEFORMATION_EXPORT std::vector<float> riseAlong(
  const Volume& volume, const glm::dvec3& direction);

/** The conditions for a weight of 1; elsewhere it is 0. */
struct Region
{
  const Grid* grid = nullptr;           ///< the point is within it; null: anywhere
  const Mask* inside = nullptr;         ///< the nearest voxel is inside; null: everywhere
  std::array<const Mask*, 2> outside{}; ///< the nearest voxel of each is not inside; null: nowhere
};

/** Whether a position (mm, world) fulfils the conditions. */
BRAINSHIFT_DEFORMATION_EXPORT bool counts(const Region& region, const glm::dvec3& world);

/** Null for a mask without voxels. */
inline const Mask* orNull(const Mask& mask)
{
  return mask.inside.empty() ? nullptr : &mask;
}

/** The neighbourhood that a value depends on: three boxes, one along each axis. */
struct Support
{
  int along = 0;  ///< points along the axis, in each direction
  int across = 0; ///< points along the other two; not above `along`
};

/** The weights of a grid's points. A point whose support holds weight 0 gets weight 0 too. */
BRAINSHIFT_DEFORMATION_EXPORT Volume weightsOf(
  const Grid& grid, const Region& region, const Support& support);

/** Limits that smaller and larger values are clamped to, so that a few outliers do not dominate. */
struct Range
{
  float low = 0.0f;
  float high = 1.0f; ///< above low

  /** 0 at the low end, 1 at the high one. */
  float fraction(float value) const
  {
    return glm::clamp((value - this->low) / (this->high - this->low), 0.0f, 1.0f);
  }
};

/** The range without 0.1 % of the values at each end. */
BRAINSHIFT_DEFORMATION_EXPORT Range rangeOf(const std::vector<float>& values);
}

#endif

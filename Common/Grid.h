// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Geometry of a regular grid in world space, as a small value, and the loop over its indices.
#ifndef BrainShift_Grid_h
#define BrainShift_Grid_h

#include <glm/glm.hpp>

#include <array>
#include <cstddef>

namespace brainshift
{
/**
 * A grid's origin lies at most so many spacings from 0. Double precision still places its points.
 */
constexpr double FarthestOriginSpacings = 1e9;

/**
 * Points in rows along three axes. Grid coordinates count points from the first one along the
 * grid's own axes. World coordinates are mm.
 */
struct Grid
{
  glm::ivec3 dimensions{ 0 };  ///< number of points along each axis
  glm::dvec3 origin{ 0.0 };    ///< mm, world position of point (0, 0, 0)
  glm::dvec3 spacing{ 1.0 };   ///< mm between neighbours along the grid's own axes; above 0
  glm::dmat3 direction{ 1.0 }; ///< columns: the grid's axes in world space; a rotation

  /** Whether the origin is near enough for the points to have places of their own. */
  bool placesItsPoints() const
  {
    const double spacing = glm::min(this->spacing.x, glm::min(this->spacing.y, this->spacing.z));
    const glm::dvec3 away = glm::abs(this->origin);
    return away.x <= FarthestOriginSpacings * spacing &&
      away.y <= FarthestOriginSpacings * spacing && away.z <= FarthestOriginSpacings * spacing;
  }

  /** Number of points. */
  std::size_t count() const
  {
    return static_cast<std::size_t>(this->dimensions.x) * this->dimensions.y * this->dimensions.z;
  }

  /** Number of a point in an array of all points, x fastest. */
  std::size_t offset(int i, int j, int k) const
  {
    return (static_cast<std::size_t>(k) * this->dimensions.y + j) * this->dimensions.x + i;
  }

  /** World position (mm) of a position in grid coordinates. */
  glm::dvec3 worldFromGrid(const glm::dvec3& position) const
  {
    return this->origin + this->direction * (this->spacing * position);
  }

  /** Grid coordinates of a world position (mm). */
  glm::dvec3 gridFromWorld(const glm::dvec3& world) const
  {
    return glm::transpose(this->direction) * (world - this->origin) / this->spacing;
  }

  /** World displacement (mm) of a displacement in grid cells. The origin does not count. */
  glm::dvec3 worldVectorFromGrid(const glm::dvec3& vector) const
  {
    return this->direction * (this->spacing * vector);
  }

  /** Displacement in grid cells of a world displacement (mm). The origin does not count. */
  glm::dvec3 gridVectorFromWorld(const glm::dvec3& vector) const
  {
    return glm::transpose(this->direction) * vector / this->spacing;
  }

  /** The grid of the middles of blocks of points. Along an axis, the last may reach beyond. */
  Grid ofBlocks(const glm::ivec3& pointsPerBlock) const
  {
    Grid blocks = *this;
    blocks.dimensions = (this->dimensions + pointsPerBlock - 1) / pointsPerBlock;
    blocks.spacing = this->spacing * glm::dvec3(pointsPerBlock);
    blocks.origin = this->worldFromGrid(0.5 * glm::dvec3(pointsPerBlock - 1));
    return blocks;
  }

  bool operator==(const Grid& other) const
  {
    return this->dimensions == other.dimensions && this->origin == other.origin &&
      this->spacing == other.spacing && this->direction == other.direction;
  }
  bool operator!=(const Grid& other) const { return !(*this == other); }
};

/** The box of a grid as 15 numbers: origin (mm), spacing (mm), direction matrix row by row. */
inline std::array<double, 15> boxOf(const Grid& grid)
{
  const glm::dmat3 rows = glm::transpose(grid.direction);
  std::array<double, 15> box;
  for (int i = 0; i < 3; ++i)
  {
    box[i] = grid.origin[i];
    box[3 + i] = grid.spacing[i];
  }
  for (int i = 0; i < 9; ++i)
  {
    box[6 + i] = rows[i / 3][i % 3];
  }
  return box;
}

/** Gives a grid the box that boxOf returned. */
inline void setBox(Grid& grid, const double* box)
{
  for (int i = 0; i < 3; ++i)
  {
    grid.origin[i] = box[i];
    grid.spacing[i] = box[3 + i];
  }
  for (int i = 0; i < 9; ++i)
  {
    grid.direction[i % 3][i / 3] = box[6 + i];
  }
}

/**
 * A grid over the same box with other numbers of points. A side that has one point counts as one
 * cell long.
 */
inline Grid withDimensions(const Grid& grid, const glm::ivec3& dimensions)
{
  Grid result = grid;
  result.dimensions = dimensions;
  const glm::dvec3 extent = grid.spacing * glm::dvec3(glm::max(grid.dimensions - 1, glm::ivec3(1)));
  result.spacing = extent / glm::dvec3(glm::max(dimensions - 1, glm::ivec3(1)));
  return result;
}

/**
 * Calls visit(index) for each index from `first` to `last`, both included, x fastest. It visits
 * nothing if `last` is below `first` along an axis.
 */
template <typename Visit>
void forEachIndex(const glm::ivec3& first, const glm::ivec3& last, Visit&& visit)
{
  glm::ivec3 index;
  for (index.z = first.z; index.z <= last.z; ++index.z)
  {
    for (index.y = first.y; index.y <= last.y; ++index.y)
    {
      for (index.x = first.x; index.x <= last.x; ++index.x)
      {
        visit(static_cast<const glm::ivec3&>(index));
      }
    }
  }
}

/**
 * Calls visit(index, weight) for the eight points around a position in grid coordinates, with the
 * weights of trilinear interpolation. A position outside the grid is moved to its border.
 */
template <typename Visit>
void forEachCorner(const Grid& grid, const glm::dvec3& position, Visit&& visit)
{
  const glm::ivec3 last = grid.dimensions - 1;
  const glm::dvec3 inside = glm::clamp(position, glm::dvec3(0.0), glm::dvec3(last));
  const glm::ivec3 low(inside);
  const glm::dvec3 within = inside - glm::dvec3(low);
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::ivec3 side(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
    const glm::dvec3 weight = glm::mix(1.0 - within, within, glm::dvec3(side));
    visit(glm::min(low + side, last), weight.x * weight.y * weight.z);
  }
}
}

#endif

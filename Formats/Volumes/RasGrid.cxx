// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Volumes/RasGrid.h"

#include "Common/ImageGrid.h"
#include "Formats/Files/Text.h"

#include <algorithm>
#include <cmath>

namespace
{
constexpr double IdentityTolerance = 1e-6;   // rotations below are float32 rounding of the header
constexpr double SmallestDeterminant = 1e-6; // of the unit axes; flatter is singular

glm::dmat3 unitColumns(const glm::dmat4& worldFromVoxel)
{
  return glm::dmat3(glm::normalize(glm::dvec3(worldFromVoxel[0])),
    glm::normalize(glm::dvec3(worldFromVoxel[1])), glm::normalize(glm::dvec3(worldFromVoxel[2])));
}

double largestDifference(const glm::dmat3& a, const glm::dmat3& b)
{
  double largest = 0.0;
  for (int column = 0; column < 3; ++column)
  {
    const glm::dvec3 difference = glm::abs(a[column] - b[column]);
    largest = std::max({ largest, difference.x, difference.y, difference.z });
  }
  return largest;
}

// The orthogonal factor of the polar decomposition, by Newton's iteration.
glm::dmat3 nearestOrthogonal(glm::dmat3 matrix)
{
  constexpr int MostSteps =
    60; // converges quadratically once near; singular-ish starts take longest
  for (int step = 0; step < MostSteps; ++step)
  {
    const glm::dmat3 next = 0.5 * (matrix + glm::transpose(glm::inverse(matrix)));
    const double change = largestDifference(next, matrix);
    matrix = next;
    if (change < 1e-15)
    {
      break;
    }
  }
  return matrix;
}

// The voxel axis along each RAS axis: the assignment whose cosines have the largest sum. For an
// orthogonal matrix that sum exceeds 1, so what remains after flipping is always a rotation.
std::array<int, 3> nearestAxes(const glm::dmat3& axes)
{
  std::array<int, 3> candidate{ 0, 1, 2 };
  std::array<int, 3> best = candidate;
  double largest = 0.0;
  do
  {
    double sum = 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      sum += std::abs(axes[candidate[axis]][axis]);
    }
    if (sum > largest + IdentityTolerance) // at a tie the file's own order stays
    {
      largest = sum;
      best = candidate;
    }
  } while (std::next_permutation(candidate.begin(), candidate.end()));
  return best;
}

double largestCosine(const glm::dmat3& axes)
{
  return std::max({ std::abs(glm::dot(axes[0], axes[1])), std::abs(glm::dot(axes[0], axes[2])),
    std::abs(glm::dot(axes[1], axes[2])) });
}

// How far apart two affine maps are at most over a box: at one of its corners.
double largestCornerDistance(const brainshift::Grid& grid, const glm::dmat4& worldFromGrid)
{
  double largest = 0.0;
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::dvec3 position = glm::dvec3(grid.dimensions - 1) *
      glm::dvec3(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1);
    const glm::dvec3 world(worldFromGrid * glm::dvec4(position, 1.0));
    largest = std::max(largest, glm::distance(world, grid.worldFromGrid(position)));
  }
  return largest;
}
}

namespace brainshift
{
void requireAffine(const glm::dmat4& worldFromVoxel)
{
  for (int column = 0; column < 4; ++column)
  {
    for (int row = 0; row < 3; ++row)
    {
      if (!std::isfinite(worldFromVoxel[column][row]))
      {
        throw Problem(joined("row ", row, ", column ", column, " of the affine is ",
          worldFromVoxel[column][row], "; it must be finite"));
      }
    }
    const double spacingMm = glm::length(glm::dvec3(worldFromVoxel[column]));
    if (column < 3 && !(spacingMm >= ShortestSpacing && spacingMm <= LongestSpacing))
    {
      throw Problem(joined("column ", column, " of the affine has length ", spacingMm,
        " mm; it must have from ", ShortestSpacing, " to ", LongestSpacing, " mm"));
    }
  }
  double spacingMm = glm::length(glm::dvec3(worldFromVoxel[0]));
  double awayMm = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    spacingMm = std::min(spacingMm, glm::length(glm::dvec3(worldFromVoxel[axis])));
    awayMm = std::max(awayMm, std::abs(worldFromVoxel[3][axis]));
  }
  if (awayMm > FarthestOriginSpacings * spacingMm)
  {
    throw Problem(joined("the offset of the affine is ", awayMm, " mm; it must be at most ",
      FarthestOriginSpacings, " times the voxel's size, ", spacingMm, " mm"));
  }
  const double determinant = glm::determinant(unitColumns(worldFromVoxel));
  if (!(std::abs(determinant) >= SmallestDeterminant))
  {
    throw Problem(joined("the affine is singular: the determinant of its unit axes is ",
      determinant, "; it must be at least ", SmallestDeterminant));
  }
}

void warnOfScaledAxes(const glm::dvec3& lengths, std::vector<std::string>& warnings)
{
  constexpr double Rounding = 1e-3;
  if (!glm::all(glm::lessThanEqual(glm::abs(lengths - 1.0), glm::dvec3(Rounding))))
  {
    warnings.push_back(joined("has directions of its axes with the lengths ", lengths.x, ", ",
      lengths.y, " and ", lengths.z, ", which should be 1; they scale its spacing"));
  }
}

RasGrid nearestRasGrid(const glm::dmat4& worldFromVoxel, const glm::ivec3& dimensions)
{
  const glm::dmat3 axes = unitColumns(worldFromVoxel);
  const glm::dmat3 orthogonal = nearestOrthogonal(axes);
  RasGrid found;
  found.shear = largestCosine(axes);
  found.voxelAxis = nearestAxes(orthogonal);
  glm::dmat4 worldFromGrid(1.0);
  worldFromGrid[3] = worldFromVoxel[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    const int voxelAxis = found.voxelAxis[axis];
    found.reversed[axis] = orthogonal[voxelAxis][axis] < 0.0;
    const double sign = found.reversed[axis] ? -1.0 : 1.0;
    found.grid.dimensions[axis] = dimensions[voxelAxis];
    found.grid.spacing[axis] = glm::length(glm::dvec3(worldFromVoxel[voxelAxis]));
    found.grid.direction[axis] = sign * orthogonal[voxelAxis];
    worldFromGrid[axis] = sign * worldFromVoxel[voxelAxis];
    if (found.reversed[axis])
    {
      worldFromGrid[3] += worldFromVoxel[voxelAxis] * double(dimensions[voxelAxis] - 1);
    }
  }
  if (largestDifference(found.grid.direction, glm::dmat3(1.0)) < IdentityTolerance)
  {
    found.grid.direction = glm::dmat3(1.0);
  }
  found.grid.origin = glm::dvec3(worldFromGrid[3]);
  if (found.shear > LargestUnreportedShear) // no corner can be right, so the centre is
  {
    const glm::dvec3 centre = 0.5 * glm::dvec3(found.grid.dimensions - 1);
    found.grid.origin =
      glm::dvec3(worldFromGrid * glm::dvec4(centre, 1.0)) - found.grid.worldVectorFromGrid(centre);
  }
  found.largestErrorMm = largestCornerDistance(found.grid, worldFromGrid);
  return found;
}
}

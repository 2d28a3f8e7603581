// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Thin plates through landmarks, as ITK's ThinPlateSplineKernelTransform defines them: the kernel
/// is the distance, beside an affine map. They pass through all landmarks.
#include "Common/Problem.h"
#include "Formats/Files/Text.h"
#include "Formats/Transforms/PointTransform.h"

#include "vtkMath.h"

#include <cmath>

namespace brainshift
{
namespace
{
constexpr std::size_t MostLandmarks = 2000; // 32 MB of equations, which take some seconds
constexpr double FlattestSpread = 1e-6;     // of the thinnest extent of landmarks to the widest
constexpr double NearestLandmarks = 1e-6;   // mm
constexpr double LargestMiss = 1e-5;        // mm

glm::dvec3 middleOf(const std::vector<glm::dvec3>& points)
{
  glm::dvec3 sum(0.0);
  for (const glm::dvec3& point : points)
  {
    sum += point;
  }
  return sum / static_cast<double>(points.size());
}

// Without a volume, the affine map across the plane of the landmarks may be any.
void requireVolume(const std::vector<glm::dvec3>& sources)
{
  const glm::dvec3 middle = middleOf(sources);
  glm::dmat3 spread(0.0);
  for (const glm::dvec3& source : sources)
  {
    spread += glm::outerProduct(source - middle, source - middle);
  }
  double rows[3][3];
  double* in[3] = { rows[0], rows[1], rows[2] };
  double vectors[3][3];
  double* out[3] = { vectors[0], vectors[1], vectors[2] };
  double extents[3] = { 0.0, 0.0, 0.0 }; // squared, the widest first
  for (int i = 0; i < 9; ++i)
  {
    rows[i / 3][i % 3] = spread[i % 3][i / 3];
  }
  const bool isSolved = vtkMath::Jacobi(in, extents, out) != 0;
  if (!isSolved || !(extents[2] > FlattestSpread * FlattestSpread * extents[0]))
  {
    throw Problem("has landmarks in one plane, on a line or at one place, which leave the map "
                  "beside them open; add a landmark outside their plane");
  }
}

void requireDifferent(const std::vector<glm::dvec3>& sources)
{
  for (std::size_t i = 0; i < sources.size(); ++i)
  {
    for (std::size_t j = 0; j < i; ++j)
    {
      if (!(glm::distance(sources[i], sources[j]) > NearestLandmarks))
      {
        throw Problem(
          joined("has the landmarks ", j, " and ", i, " at one place; leave one of them out"));
      }
    }
  }
}

// Equations of thin plates, by rows: a weight for each landmark, then a constant and a slope.
class Equations
{
public:
  explicit Equations(const std::vector<glm::dvec3>& sources)
    : Side(sources.size() + 4)
    , Numbers(this->Side * this->Side, 0.0)
    , Rows(this->Side)
    , Pivots(this->Side)
  {
    for (std::size_t i = 0; i < this->Side; ++i)
    {
      this->Rows[i] = this->Numbers.data() + i * this->Side;
    }
    const std::size_t count = sources.size();
    for (std::size_t i = 0; i < count; ++i)
    {
      for (std::size_t j = 0; j < count; ++j)
      {
        this->Rows[i][j] = glm::distance(sources[i], sources[j]);
      }
      const double beside[4] = { 1.0, sources[i].x, sources[i].y, sources[i].z };
      for (std::size_t k = 0; k < 4; ++k)
      {
        this->Rows[i][count + k] = beside[k];
        this->Rows[count + k][i] = beside[k];
      }
    }
  }

  bool factor()
  {
    return vtkMath::LUFactorLinearSystem(
             this->Rows.data(), this->Pivots.data(), static_cast<int>(this->Side)) != 0;
  }

  std::vector<double> solved(std::vector<double> right)
  {
    vtkMath::LUSolveLinearSystem(
      this->Rows.data(), this->Pivots.data(), right.data(), static_cast<int>(this->Side));
    return right;
  }

private:
  std::size_t Side;
  std::vector<double> Numbers;
  std::vector<double*> Rows;
  std::vector<int> Pivots;
};
}

TransformLink throughLandmarks(
  const std::vector<glm::dvec3>& sources, const std::vector<glm::dvec3>& targets)
{
  const std::size_t count = sources.size();
  if (count < 4 || count > MostLandmarks)
  {
    throw Problem(joined("has ", count, " landmarks; thin plates need from 4 to ", MostLandmarks));
  }
  requireVolume(sources);
  requireDifferent(sources);
  const glm::dvec3 middle = middleOf(sources); // near 0, equations keep their digits
  std::vector<glm::dvec3> centred = sources;
  for (glm::dvec3& source : centred)
  {
    source -= middle;
  }
  Equations equations(centred);
  if (!equations.factor())
  {
    throw Problem("has landmarks that no thin plates pass through");
  }
  ThinPlateLink link{ sources, std::vector<glm::dvec3>(count), {} };
  for (int axis = 0; axis < 3; ++axis)
  {
    std::vector<double> right(count + 4, 0.0);
    for (std::size_t i = 0; i < count; ++i)
    {
      right[i] = targets[i][axis];
    }
    const std::vector<double> found = equations.solved(right);
    for (std::size_t i = 0; i < count; ++i)
    {
      link.weights[i][axis] = found[i];
    }
    for (int column = 0; column < 3; ++column)
    {
      link.base.linear[column][axis] = found[count + 1 + static_cast<std::size_t>(column)];
    }
    link.base.offset[axis] = found[count];
  }
  link.base.offset -= link.base.linear * middle;
  const PointTransform chain{ { link } };
  for (std::size_t i = 0; i < count; ++i)
  {
    const double miss = glm::distance(mapped(chain, sources[i]), targets[i]);
    if (!(miss <= LargestMiss)) // also rejects NaN
    {
      throw Problem(
        joined("has landmarks that no thin plates pass through: the map misses landmark ", i,
          " by ", miss, " mm; two of them may be at one place"));
    }
  }
  return link;
}
}

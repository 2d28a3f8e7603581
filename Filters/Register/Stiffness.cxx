// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Register/Stiffness.h"

#include "Filters/Register/LatticeRows.h"

#include <cmath>

namespace brainshift
{
namespace
{
// Factors of the energy: that of shear and of volume (Lame's constants), and that of bending. Brain
// shift is wide. If most of the energy were elastic, a wide deformation would cost more than many
// small errors; bending energy is the other way round.
constexpr float Shear = 0.1f;
constexpr float Compression = 0.05f;
constexpr float Bending = 1.0f;

constexpr float Converged = 1e-4f; // of the squared residual that a Newton step begins with
constexpr int MostSolverSteps = 40;

// The two axes of each of the six second derivatives.
constexpr int FirstAxis[6] = { 0, 1, 2, 0, 0, 1 };
constexpr int SecondAxis[6] = { 0, 1, 2, 1, 2, 2 };

// The stress of the cell that begins at a control point, and the curvature at the point itself.
struct Tension
{
  glm::mat3 stress{ 0.0f };              // column: along that axis; for each mm of the corners
  std::array<glm::vec3, 6> curvatures{}; // second derivatives times their weight
};

glm::ivec3 stepAlong(int axis)
{
  glm::ivec3 step(0);
  step[axis] = 1;
  return step;
}

bool isWithin(const glm::ivec3& index, const glm::ivec3& dimensions)
{
  return index.x >= 0 && index.y >= 0 && index.z >= 0 && index.x < dimensions.x &&
    index.y < dimensions.y && index.z < dimensions.z;
}

// All points of a lattice, slabs on several cores.
template <typename Visit>
void forEachControl(const Grid& grid, const Visit& visit)
{
  parallelFor(0, grid.dimensions.z, 1, [&](std::int64_t begin, std::int64_t end) {
    glm::ivec3 index;
    for (index.z = static_cast<int>(begin); index.z < end; ++index.z)
    {
      for (index.y = 0; index.y < grid.dimensions.y; ++index.y)
      {
        for (index.x = 0; index.x < grid.dimensions.x; ++index.x)
        {
          visit(static_cast<const glm::ivec3&>(index), grid.offset(index.x, index.y, index.z));
        }
      }
    }
  });
}

// The numbers of neighbours beside a point of an array.
struct Steps
{
  explicit Steps(const Grid& grid)
    : along{ 1, static_cast<std::ptrdiff_t>(grid.offset(0, 1, 0)),
      static_cast<std::ptrdiff_t>(grid.offset(0, 0, 1)) }
  {
  }
  std::ptrdiff_t along[3];

  std::ptrdiff_t toCorner(int corner) const
  {
    return (corner & 1 ? this->along[0] : 0) + (corner & 2 ? this->along[1] : 0) +
      (corner & 4 ? this->along[2] : 0);
  }
};

// The stress of the cell whose first corner is at `first`.
glm::mat3 stressOf(const glm::vec3* first, const Steps& steps, const glm::vec3& perMm)
{
  glm::mat3 gradient(0.0f); // column: derivative along that axis
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::vec3& d = first[steps.toCorner(corner)];
    for (int axis = 0; axis < 3; ++axis)
    {
      gradient[axis] += (corner >> axis & 1) ? d : -d;
    }
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    gradient[axis] *= perMm[axis];
  }
  glm::mat3 stress = Shear * (gradient + glm::transpose(gradient));
  const float growth = Compression * (gradient[0][0] + gradient[1][1] + gradient[2][2]);
  for (int axis = 0; axis < 3; ++axis)
  {
    stress[axis][axis] += growth;
    stress[axis] *= perMm[axis];
  }
  return stress;
}

// The second difference around a point along two axes, counted twice where they differ.
glm::vec3 secondDifference(
  const glm::vec3* d, const glm::ivec3& at, const glm::ivec3& sides, const Steps& steps, int c)
{
  const int a = FirstAxis[c];
  const int b = SecondAxis[c];
  const std::ptrdiff_t toA = steps.along[a];
  const std::ptrdiff_t toB = steps.along[b];
  if (a == b)
  {
    const bool isWhole = at[a] > 0 && at[a] + 1 < sides[a];
    return isWhole ? d[-toA] - 2.0f * d[0] + d[toA] : glm::vec3(0.0f);
  }
  const bool isWhole = at[a] + 1 < sides[a] && at[b] + 1 < sides[b];
  return isWhole ? 2.0f * (d[toA + toB] - d[toA] - d[toB] + d[0]) : glm::vec3(0.0f);
}
}

Stiffness::Stiffness(const Grid& lattice, double factor)
  : Lattice(lattice)
  , Factor(static_cast<float>(factor / lattice.count()))
{
  const glm::vec3 h(lattice.spacing);
  const glm::vec3 squares = 1.0f / (h * h);
  const float mean = std::cbrt(h.x * h.y * h.z);
  this->Diagonal = this->Factor *
    ((2 * Shear + Compression) * (squares.x + squares.y + squares.z) / 4 +
      20 * Bending / (mean * mean));
}

std::vector<glm::vec3> Stiffness::times(const std::vector<glm::vec3>& displacements) const
{
  const glm::ivec3 sides = this->Lattice.dimensions;
  const glm::vec3 h(this->Lattice.spacing);
  const glm::vec3 perMm = 0.25f / h;
  const float mean = std::cbrt(h.x * h.y * h.z);
  const Steps steps(this->Lattice);
  std::vector<Tension> tensions(displacements.size());
  forEachControl(this->Lattice, [&](const glm::ivec3& at, std::size_t number) {
    const glm::vec3* d = &displacements[number];
    Tension& tension = tensions[number];
    if (isWithin(at + 1, sides))
    {
      tension.stress = stressOf(d, steps, perMm);
    }
    for (int c = 0; c < 6; ++c)
    {
      const glm::vec3 squares = h * h;
      tension.curvatures[c] = Bending * mean * mean /
        (squares[FirstAxis[c]] * squares[SecondAxis[c]]) * secondDifference(d, at, sides, steps, c);
    }
  });
  std::vector<glm::vec3> result(displacements.size());
  forEachControl(this->Lattice, [&](const glm::ivec3& at, std::size_t number) {
    const Tension* own = &tensions[number];
    glm::vec3 sum(0.0f);
    for (int corner = 0; corner < 8; ++corner)
    {
      if (isWithin(at - glm::ivec3(corner & 1, corner >> 1 & 1, corner >> 2), sides))
      {
        const glm::mat3& stress = own[-steps.toCorner(corner)].stress;
        for (int axis = 0; axis < 3; ++axis)
        {
          sum += (corner >> axis & 1) ? stress[axis] : -stress[axis];
        }
      }
    }
    for (int c = 0; c < 6; ++c)
    {
      const int a = FirstAxis[c];
      const int b = SecondAxis[c];
      const auto curvature = [&](const glm::ivec3& offset) {
        return isWithin(at + offset, sides)
          ? own[offset.x * steps.along[0] + offset.y * steps.along[1] + offset.z * steps.along[2]]
              .curvatures[c]
          : glm::vec3(0.0f);
      };
      const glm::ivec3 toA = stepAlong(a);
      const glm::ivec3 toB = stepAlong(b);
      sum += a == b
        ? curvature(-toA) - 2.0f * own->curvatures[c] + curvature(toA)
        : own->curvatures[c] - curvature(-toA) - curvature(-toB) + curvature(-toA - toB);
    }
    result[number] = this->Factor * sum;
  });
  return result;
}

double dot(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    sum += glm::dot(a[i], b[i]);
  }
  return sum;
}

std::vector<glm::vec3> newtonStep(
  const Stiffness& stiffness, const std::vector<float>& forces, const std::vector<glm::vec3>& bend)
{
  const std::size_t count = bend.size();
  std::vector<glm::mat3> hessians(count);
  std::vector<glm::mat3> inverses(count);
  std::vector<glm::vec3> residual = stiffness.times(bend);
  for (std::size_t i = 0; i < count; ++i)
  {
    const float* f = &forces[i * ForceNumbers];
    hessians[i] = { f[3], f[6], f[7], f[6], f[4], f[8], f[7], f[8], f[5] };
    // A scale of its own keeps the inverse's numbers within single precision.
    const glm::mat3 block = hessians[i] / stiffness.diagonal() + glm::mat3(1.0f);
    inverses[i] = glm::inverse(block) / stiffness.diagonal();
    residual[i] = glm::vec3(f[0], f[1], f[2]) - residual[i];
  }
  std::vector<glm::vec3> step(count, glm::vec3(0.0f));
  std::vector<glm::vec3> scaled(count);
  std::vector<glm::vec3> along(count, glm::vec3(0.0f));
  double first = 0.0;
  double last = 1.0;
  for (int solverStep = 0; solverStep < MostSolverSteps; ++solverStep)
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      scaled[i] = inverses[i] * residual[i];
    }
    const double size = dot(residual, scaled);
    first = solverStep == 0 ? size : first;
    if (!(size > Converged * first))
    {
      break;
    }
    for (std::size_t i = 0; i < count; ++i)
    {
      along[i] = scaled[i] + static_cast<float>(size / last) * along[i];
    }
    last = size;
    std::vector<glm::vec3> image = stiffness.times(along);
    for (std::size_t i = 0; i < count; ++i)
    {
      image[i] += hessians[i] * along[i];
    }
    const double curve = dot(along, image);
    if (!(curve > 0.0))
    {
      break;
    }
    const float length = static_cast<float>(size / curve);
    for (std::size_t i = 0; i < count; ++i)
    {
      step[i] += length * along[i];
      residual[i] -= length * image[i];
    }
  }
  return step;
}
}

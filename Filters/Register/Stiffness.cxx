// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Register/Stiffness.h"

#include "Filters/Register/LatticeRows.h"

#include <algorithm>
#include <cmath>
#include <utility>

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

// Of the lumped Hessian: what steps find is 0.1 to 0.4.
constexpr double UsualShare = 0.4;
constexpr double LeastShare = 0.05;

// Rows of a lattice as plain numbers, three for each control point, so that the compiler makes
// vector instructions of all loops. Terms of the energy are taken row by row: the differences that
// a term squares, and from them its derivatives, which are added to the rows that it depends on.
constexpr int Axes = 3;

// A row of differences, with a zero point before and behind it.
class Differences
{
public:
  explicit Differences(int points)
    : Values(static_cast<std::size_t>(points + 2) * Axes, 0.0f)
  {
  }
  float* row() { return this->Values.data() + Axes; }

private:
  std::vector<float> Values;
};

class EnergyRows
{
public:
  EnergyRows(const Grid& lattice, const std::vector<glm::vec3>& displacements,
    std::vector<glm::vec3>& derivatives)
    : Sides(lattice.dimensions)
    , Numbers(Axes * lattice.dimensions.x)
    , From(&displacements.front().x)
    , To(&derivatives.front().x)
    , A(lattice.dimensions.x)
    , B(lattice.dimensions.x)
    , C(lattice.dimensions.x)
  {
  }

  // Weight times the square of the second difference along x, and along y or z by `step`.
  void addAlongX(int j, int k, float weight);
  void addAlong(int j, int k, const glm::ivec2& step, float weight);

  // The same of the mixed difference along x and `step`, and along y and z.
  void addMixedWithX(int j, int k, const glm::ivec2& step, float weight);
  void addMixed(int j, int k, float weight);

  // Elastic energy of the cells between four rows. `perMm`: a quarter of a step along each axis.
  void addElastic(int j, int k, const glm::vec3& perMm);

private:
  std::ptrdiff_t at(int j, int k) const
  {
    return (static_cast<std::ptrdiff_t>(k) * this->Sides.y + j) * this->Numbers;
  }
  const float* from(int j, int k) const { return this->From + this->at(j, k); }
  float* to(int j, int k) const { return this->To + this->at(j, k); }
  void takeStresses(const glm::vec3& perMm);

  glm::ivec3 Sides;
  int Numbers; // of a row
  const float* From;
  float* To;
  Differences A;
  Differences B;
  Differences C;
};

void EnergyRows::addAlongX(int j, int k, float weight)
{
  const float* d = this->from(j, k);
  float* to = this->to(j, k);
  float* v = this->A.row();
  for (int n = Axes; n < this->Numbers - Axes; ++n)
  {
    v[n] = weight * (d[n - Axes] - 2.0f * d[n] + d[n + Axes]);
  }
  std::fill(v, v + Axes, 0.0f);
  std::fill(v + this->Numbers - Axes, v + this->Numbers, 0.0f);
  for (int n = 0; n < this->Numbers; ++n)
  {
    to[n] += v[n - Axes] - 2.0f * v[n] + v[n + Axes];
  }
}

void EnergyRows::addAlong(int j, int k, const glm::ivec2& step, float weight)
{
  const float* before = this->from(j - step.x, k - step.y);
  const float* d = this->from(j, k);
  const float* behind = this->from(j + step.x, k + step.y);
  float* toBefore = this->to(j - step.x, k - step.y);
  float* to = this->to(j, k);
  float* toBehind = this->to(j + step.x, k + step.y);
  for (int n = 0; n < this->Numbers; ++n)
  {
    const float v = weight * (before[n] - 2.0f * d[n] + behind[n]);
    toBefore[n] += v;
    to[n] -= 2.0f * v;
    toBehind[n] += v;
  }
}

void EnergyRows::addMixedWithX(int j, int k, const glm::ivec2& step, float weight)
{
  const float* d = this->from(j, k);
  const float* behind = this->from(j + step.x, k + step.y);
  float* to = this->to(j, k);
  float* toBehind = this->to(j + step.x, k + step.y);
  float* v = this->A.row();
  for (int n = 0; n < this->Numbers - Axes; ++n)
  {
    v[n] = 2.0f * weight * (behind[n + Axes] - behind[n] - d[n + Axes] + d[n]);
  }
  std::fill(v + this->Numbers - Axes, v + this->Numbers, 0.0f);
  for (int n = 0; n < this->Numbers; ++n)
  {
    const float change = v[n] - v[n - Axes];
    to[n] += change;
    toBehind[n] -= change;
  }
}

void EnergyRows::addMixed(int j, int k, float weight)
{
  const float* rows[4];
  float* toRows[4];
  for (int row = 0; row < 4; ++row)
  {
    rows[row] = this->from(j + (row & 1), k + (row >> 1));
    toRows[row] = this->to(j + (row & 1), k + (row >> 1));
  }
  for (int n = 0; n < this->Numbers; ++n)
  {
    const float v = 2.0f * weight * (rows[3][n] - rows[1][n] - rows[2][n] + rows[0][n]);
    toRows[0][n] += v;
    toRows[1][n] -= v;
    toRows[2][n] -= v;
    toRows[3][n] += v;
  }
}

// A, B and C are derivatives along x, y and z for each cell of a row; stresses replace them.
void EnergyRows::takeStresses(const glm::vec3& perMm)
{
  float* rows[Axes] = { this->A.row(), this->B.row(), this->C.row() };
  for (int n = 0; n < this->Numbers - Axes; n += Axes)
  {
    float gradient[Axes][Axes];
    for (int axis = 0; axis < Axes; ++axis)
    {
      std::copy(rows[axis] + n, rows[axis] + n + Axes, gradient[axis]);
    }
    const float growth = Compression * (gradient[0][0] + gradient[1][1] + gradient[2][2]);
    for (int axis = 0; axis < Axes; ++axis)
    {
      for (int c = 0; c < Axes; ++c)
      {
        const float shear = Shear * (gradient[axis][c] + gradient[c][axis]);
        rows[axis][n + c] = perMm[axis] * (shear + (axis == c ? growth : 0.0f));
      }
    }
  }
  for (float* row : rows)
  {
    std::fill(row + this->Numbers - Axes, row + this->Numbers, 0.0f);
  }
}

void EnergyRows::addElastic(int j, int k, const glm::vec3& perMm)
{
  const float* d[4];
  float* to[4];
  for (int row = 0; row < 4; ++row)
  {
    d[row] = this->from(j + (row & 1), k + (row >> 1));
    to[row] = this->to(j + (row & 1), k + (row >> 1));
  }
  float* x = this->A.row();
  float* y = this->B.row();
  float* z = this->C.row();
  for (int n = 0; n < this->Numbers; ++n)
  {
    x[n] = d[0][n] + d[1][n] + d[2][n] + d[3][n];
    y[n] = d[1][n] + d[3][n] - d[0][n] - d[2][n];
    z[n] = d[2][n] + d[3][n] - d[0][n] - d[1][n];
  }
  for (int n = 0; n < this->Numbers - Axes; ++n)
  {
    x[n] = perMm.x * (x[n + Axes] - x[n]);
    y[n] = perMm.y * (y[n + Axes] + y[n]);
    z[n] = perMm.z * (z[n + Axes] + z[n]);
  }
  this->takeStresses(perMm);
  for (int n = 0; n < this->Numbers; ++n)
  {
    const float alongX = x[n - Axes] - x[n];
    const float alongY = y[n - Axes] + y[n];
    const float alongZ = z[n - Axes] + z[n];
    to[0][n] += alongX - alongY - alongZ;
    to[1][n] += alongX + alongY - alongZ;
    to[2][n] += alongX - alongY + alongZ;
    to[3][n] += alongX + alongY + alongZ;
  }
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
  const float mean = std::cbrt(h.x * h.y * h.z);
  const auto weight = [&](int a, int b) {
    return this->Factor * Bending * mean * mean / (h[a] * h[a] * h[b] * h[b]);
  };
  std::vector<glm::vec3> result(displacements.size(), glm::vec3(0.0f));
  EnergyRows rows(this->Lattice, displacements, result);
  const glm::vec3 perMm = 0.25f * std::sqrt(this->Factor) / h;
  for (int k = 0; k < sides.z; ++k)
  {
    for (int j = 0; j < sides.y; ++j)
    {
      const bool hasRow = j + 1 < sides.y;
      const bool hasSlab = k + 1 < sides.z;
      rows.addAlongX(j, k, weight(0, 0));
      if (hasRow)
      {
        rows.addMixedWithX(j, k, { 1, 0 }, weight(0, 1));
      }
      if (hasSlab)
      {
        rows.addMixedWithX(j, k, { 0, 1 }, weight(0, 2));
      }
      if (hasRow && hasSlab)
      {
        rows.addMixed(j, k, weight(1, 2));
        rows.addElastic(j, k, perMm);
      }
      if (hasRow && j > 0)
      {
        rows.addAlong(j, k, { 1, 0 }, weight(1, 1));
      }
      if (hasSlab && k > 0)
      {
        rows.addAlong(j, k, { 0, 1 }, weight(2, 2));
      }
    }
  }
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

std::vector<glm::vec3> pullOf(const Stiffness& stiffness, const std::vector<float>& forces,
  const std::vector<glm::vec3>& displacements)
{
  std::vector<glm::vec3> pull = stiffness.times(displacements);
  for (std::size_t i = 0; i < pull.size(); ++i)
  {
    const float* f = &forces[i * ForceNumbers];
    pull[i] = glm::vec3(f[0], f[1], f[2]) - pull[i];
  }
  return pull;
}

namespace
{
void add(std::vector<glm::vec3>& sum, double factor, const std::vector<glm::vec3>& vectors)
{
  for (std::size_t i = 0; i < sum.size(); ++i)
  {
    sum[i] += static_cast<float>(factor) * vectors[i];
  }
}

std::vector<glm::mat3> hessiansOf(const std::vector<float>& forces, std::size_t count)
{
  std::vector<glm::mat3> hessians(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    const float* f = &forces[i * ForceNumbers];
    hessians[i] = { f[3], f[6], f[7], f[6], f[4], f[8], f[7], f[8], f[5] };
  }
  return hessians;
}

// How much of the lumped Hessian the last step found.
double shareFound(const Stiffness& stiffness, const std::vector<glm::mat3>& hessians,
  const StepTaken& last, double product)
{
  double lumped = 0.0;
  for (std::size_t i = 0; i < hessians.size(); ++i)
  {
    lumped += glm::dot(last.way[i], hessians[i] * last.way[i]);
  }
  const double found = product - dot(last.way, stiffness.times(last.way));
  return lumped > 0.0 ? std::clamp(found / lumped, LeastShare, 1.0) : 1.0;
}

// Solves (H + R) step = residual.
std::vector<glm::vec3> solved(const Stiffness& stiffness, const std::vector<glm::mat3>& hessians,
  std::vector<glm::vec3> residual)
{
  const std::size_t count = hessians.size();
  std::vector<glm::mat3> inverses(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    // A scale of its own keeps the inverse's numbers within single precision.
    const glm::mat3 block = hessians[i] / stiffness.diagonal() + glm::mat3(1.0f);
    inverses[i] = glm::inverse(block) / stiffness.diagonal();
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

std::vector<glm::vec3> newtonStep(const Stiffness& stiffness, const std::vector<float>& forces,
  std::vector<glm::vec3> pull, const StepTaken* last)
{
  const double product = last ? dot(last->way, last->drop) : 0.0;
  const bool isKnown = product > 0.0; // else the energy does not curve upwards there
  std::vector<glm::mat3> hessians = hessiansOf(forces, pull.size());
  const double share = isKnown ? shareFound(stiffness, hessians, *last, product) : UsualShare;
  for (glm::mat3& hessian : hessians)
  {
    hessian *= static_cast<float>(share);
  }
  if (!isKnown)
  {
    return solved(stiffness, hessians, std::move(pull));
  }
  const double along = dot(last->way, pull) / product;
  add(pull, -along, last->drop);
  std::vector<glm::vec3> step = solved(stiffness, hessians, std::move(pull));
  add(step, along - dot(last->drop, step) / product, last->way);
  return step;
}
}

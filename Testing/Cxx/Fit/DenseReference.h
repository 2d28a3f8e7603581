// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The same process, written down plainly: full matrices and Gauss's elimination. And scattered
/// points of a fixed seed.
#ifndef BrainShift_Testing_DenseReference_h
#define BrainShift_Testing_DenseReference_h

#include "Filters/Fit/Process.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <utility>
#include <vector>

namespace brainshift::testing
{
using Numbers = std::vector<double>;
using Matrix = std::vector<Numbers>; // rows

/** Solves a x = b for each column of b, by elimination with pivots. */
inline Matrix solved(Matrix a, Matrix b)
{
  const std::size_t count = a.size();
  for (std::size_t k = 0; k < count; ++k)
  {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < count; ++i)
    {
      pivot = std::abs(a[i][k]) > std::abs(a[pivot][k]) ? i : pivot;
    }
    std::swap(a[k], a[pivot]);
    std::swap(b[k], b[pivot]);
    for (std::size_t i = 0; i < count; ++i)
    {
      const double factor = i == k ? 0.0 : a[i][k] / a[k][k];
      for (std::size_t j = k; factor != 0.0 && j < count; ++j)
      {
        a[i][j] -= factor * a[k][j];
      }
      for (std::size_t j = 0; factor != 0.0 && j < b[i].size(); ++j)
      {
        b[i][j] -= factor * b[k][j];
      }
    }
  }
  for (std::size_t k = 0; k < count; ++k)
  {
    for (double& value : b[k])
    {
      value /= a[k][k];
    }
  }
  return b;
}

/** Covariance of what two rows measure, without noise. */
inline double covarianceOf(const Matern& kernel, const Row& a, const Row& b)
{
  const double s = std::sqrt(5.0) * glm::distance(a.point, b.point) / kernel.lengthMm;
  return kernel.deviationMm * kernel.deviationMm * (1.0 + s + s * s / 3.0) * std::exp(-s) *
    glm::dot(a.axis, b.axis);
}

/** The rows that would measure all of the displacement at a position. */
inline std::vector<Row> probe(const glm::dvec3& at)
{
  return { { at, { 1, 0, 0 }, 0.0, 0.0 }, { at, { 0, 1, 0 }, 0.0, 0.0 },
    { at, { 0, 0, 1 }, 0.0, 0.0 } };
}

/** What a small motion of a mean does along a row. */
inline Numbers meanRow(const Row& row, const glm::dvec3& centre)
{
  const glm::dvec3 turn = glm::cross(row.point - centre, row.axis);
  return { row.axis.x, row.axis.y, row.axis.z, turn.x, turn.y, turn.z };
}

/** The answers of a process at one position. */
struct Answer
{
  glm::dvec3 displacement{ 0.0 };
  glm::dmat3 covariance{ 0.0 };
};

/**
 * Mean and covariance at a position. With a mean, its six numbers are unknowns like the weights:
 * [A H; H^T -P] [w; b] = [d; 0].
 */
inline Answer answerOf(const Matern& kernel, const std::vector<Row>& rows, const glm::dvec3& at,
  const RigidMean* mean = nullptr)
{
  const std::size_t count = rows.size();
  const std::size_t order = count + (mean ? 6 : 0);
  const std::vector<Row> asked = probe(at);
  Matrix a(order, Numbers(order, 0.0));
  Matrix b(order, Numbers(4, 0.0)); // the values, then the three rows that are asked for
  for (std::size_t i = 0; i < count; ++i)
  {
    for (std::size_t j = 0; j < count; ++j)
    {
      a[i][j] = covarianceOf(kernel, rows[i], rows[j]);
    }
    a[i][i] += rows[i].variance;
    b[i][0] = rows[i].value;
    for (int axis = 0; axis < 3; ++axis)
    {
      b[i][1 + axis] = covarianceOf(kernel, rows[i], asked[axis]);
    }
  }
  for (int k = 0; mean && k < 6; ++k)
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      a[count + k][i] = a[i][count + k] = meanRow(rows[i], mean->centre)[k];
    }
    a[count + k][count + k] = k < 3 ? 0.0 : -mean->rotationPrecision;
    for (int axis = 0; axis < 3; ++axis)
    {
      b[count + k][1 + axis] = meanRow(asked[axis], mean->centre)[k];
    }
  }
  const Matrix x = solved(a, b);
  Answer answer;
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      answer.covariance[column][row] = covarianceOf(kernel, asked[row], asked[column]);
    }
    for (std::size_t i = 0; i < order; ++i)
    {
      answer.displacement[row] += b[i][1 + row] * x[i][0];
      for (int column = 0; column < 3; ++column)
      {
        answer.covariance[column][row] -= b[i][1 + row] * x[i][1 + column];
      }
    }
  }
  return answer;
}

/** Numbers of a fixed seed, the same on each machine. */
class Scatter
{
public:
  explicit Scatter(unsigned seed)
    : Engine(seed)
  {
  }

  /** Between -1 and 1. */
  double number() { return 2.0 * (this->Engine() / 4294967295.0) - 1.0; }

  /** Each coordinate between -size and size. */
  glm::dvec3 point(double size)
  {
    const double x = this->number();
    const double y = this->number();
    const double z = this->number();
    return size * glm::dvec3(x, y, z);
  }

private:
  std::mt19937 Engine;
};

/** Rows of all kinds: `vectors` times three at one point, then `normals` along any axis. */
inline std::vector<Row> someRows(Scatter& scatter, int vectors, int normals)
{
  std::vector<Row> rows;
  for (int i = 0; i < vectors; ++i)
  {
    for (Row row : probe(scatter.point(60.0)))
    {
      row.value = 5.0 * scatter.number();
      row.variance = 0.49;
      rows.push_back(row);
    }
  }
  for (int i = 0; i < normals; ++i)
  {
    const glm::dvec3 at = scatter.point(60.0);
    const glm::dvec3 axis = glm::normalize(scatter.point(1.0));
    rows.push_back({ at, axis, 5.0 * scatter.number(), 0.25 + 0.01 * i });
  }
  return rows;
}
}

#endif

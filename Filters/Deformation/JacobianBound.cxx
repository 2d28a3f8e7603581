// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Deformation/JacobianBound.h"

#include "Filters/Deformation/Kernels.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace brainshift
{
namespace
{
constexpr int LargestBoxes = 2000;      // for a proof; where they do not do, it counts as failed
constexpr int Stride[3] = { 1, 4, 16 }; // to the next control point along an axis

// |a x b| when the signs of all numbers are the worst.
glm::vec3 largestCross(const glm::vec3& a, const glm::vec3& b)
{
  return { a.y * b.z + a.z * b.y, a.z * b.x + a.x * b.z, a.x * b.y + a.y * b.x };
}

// Index of the first control point of one of the 16 rows along an axis.
int rowStart(int axis, int row)
{
  const int low = row & 3;
  const int high = row >> 2;
  return axis == 0 ? 4 * low + 16 * high : axis == 1 ? low + 16 * high : low + 4 * high;
}

struct LinearRange
{
  float middle;
  glm::vec3 slope; // across the box
  float rest;      // at most, to either side
};

// A linear function near a cubic's derivative along an axis (times the box's size / 3), and how far
// off it is. The derivative's Bernstein coefficients lie at regular places in the box; what is left
// of them is a bound on what is left of it.
LinearRange linearRange(const float* value, int axis)
{
  const int own = Stride[axis];
  const auto difference = [&](int at) { return value[at + own] - value[at]; };
  const int last[3] = { axis == 0 ? 2 : 3, axis == 1 ? 2 : 3, axis == 2 ? 2 : 3 };
  LinearRange range{ 0.0f, glm::vec3(0.0f), 0.0f };
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::ivec3 side(corner & 1, corner >> 1 & 1, corner >> 2);
    const float at = 0.125f *
      difference(side.x * last[0] + side.y * last[1] * Stride[1] + side.z * last[2] * Stride[2]);
    range.middle += at;
    range.slope += at * glm::vec3(4 * side - 2);
  }
  const glm::vec3 step(range.slope.x / last[0], range.slope.y / last[1], range.slope.z / last[2]);
  float least = 0.0f;
  float greatest = 0.0f;
  for (int k = 0; k <= last[2]; ++k)
  {
    for (int j = 0; j <= last[1]; ++j)
    {
      float linear = range.middle - 0.5f * (range.slope.x + range.slope.y + range.slope.z) +
        static_cast<float>(j) * step.y + static_cast<float>(k) * step.z;
      for (int i = 0; i <= last[0]; ++i, linear += step.x)
      {
        const float left = difference(i + j * Stride[1] + k * Stride[2]) - linear;
        least = left < least ? left : least;
        greatest = left > greatest ? left : greatest;
      }
    }
  }
  range.middle += 0.5f * (least + greatest);
  range.rest = 0.5f * (greatest - least);
  return range;
}

// Least and greatest difference between neighbours along an axis.
std::pair<float, float> differences(const float* value, int axis)
{
  const int stride = Stride[axis];
  float least = value[stride] - value[0];
  float greatest = least;
  for (int row = 0; row < 16; ++row)
  {
    const float* at = value + rowStart(axis, row);
    for (int step = 0; step < 3; ++step, at += stride)
    {
      const float difference = at[stride] - at[0];
      least = difference < least ? difference : least;
      greatest = difference > greatest ? difference : greatest;
    }
  }
  return { least, greatest };
}

// A cubic in Bernstein form over a box.
struct CubicBox
{
  CellTaps coefficients;
  glm::vec3 perCell{ 1.0f }; // such boxes in a lattice cell along each axis

  ColumnBounds columns() const
  {
    ColumnBounds result;
    for (int axis = 0; axis < 3; ++axis)
    {
      for (int component = 0; component < 3; ++component)
      {
        const LinearRange range = linearRange(this->coefficients.component[component].data(), axis);
        const float scale = 3.0f * this->perCell[axis];
        result.middle[axis][component] = scale * range.middle + (axis == component ? 1.0f : 0.0f);
        result.rest[axis][component] = scale * range.rest;
        for (int along = 0; along < 3; ++along)
        {
          result.slope[axis][along][component] = scale * range.slope[along];
        }
      }
    }
    return result;
  }

  // Without slopes.
  ColumnBounds hull() const
  {
    ColumnBounds result;
    for (int axis = 0; axis < 3; ++axis)
    {
      const float scale = 3.0f * this->perCell[axis];
      for (int component = 0; component < 3; ++component)
      {
        const auto [least, greatest] =
          differences(this->coefficients.component[component].data(), axis);
        result.middle[axis][component] =
          0.5f * scale * (least + greatest) + (axis == component ? 1.0f : 0.0f);
        result.rest[axis][component] = 0.5f * scale * (greatest - least);
      }
      result.slope[axis] = glm::mat3(0.0f);
    }
    return result;
  }

  // At the first corner, or at the last.
  float determinantAtCorner(bool last) const
  {
    glm::mat3 jacobian(1.0f);
    for (int axis = 0; axis < 3; ++axis)
    {
      const int to = last ? 63 : Stride[axis];
      const int from = to - Stride[axis];
      for (int component = 0; component < 3; ++component)
      {
        const auto& value = this->coefficients.component[component];
        jacobian[axis][component] += 3.0f * this->perCell[axis] * (value[to] - value[from]);
      }
    }
    return glm::determinant(jacobian);
  }

  // Halves along an axis: this becomes the lower half, the upper one is returned.
  CubicBox split(int axis)
  {
    this->perCell[axis] *= 2.0f;
    CubicBox upper = *this;
    const int stride = Stride[axis];
    for (int component = 0; component < 3; ++component)
    {
      for (int row = 0; row < 16; ++row)
      {
        float* low = this->coefficients.component[component].data() + rowStart(axis, row);
        float* high = upper.coefficients.component[component].data() + rowStart(axis, row);
        const float first = 0.5f * (low[0] + low[stride]);
        const float middle = 0.5f * (low[stride] + low[2 * stride]);
        const float last = 0.5f * (low[2 * stride] + low[3 * stride]);
        const float below = 0.5f * (first + middle);
        const float above = 0.5f * (middle + last);
        low[stride] = first;
        low[2 * stride] = below;
        low[3 * stride] = 0.5f * (below + above);
        high[0] = low[3 * stride];
        high[stride] = above;
        high[2 * stride] = last;
      }
    }
    return upper;
  }
};

// Bernstein coefficients of the kernel's cubic between the second and the third control point.
CubicBox cubicOf(const CellTaps& taps, int kernel)
{
  CubicBox box;
  box.coefficients = taps;
  for (auto& component : box.coefficients.component)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const int stride = Stride[axis];
      for (int row = 0; row < 16; ++row)
      {
        float* b = component.data() + rowStart(axis, row);
        const float p[4] = { b[0], b[stride], b[2 * stride], b[3 * stride] };
        const bool smooth = kernel == KernelBSpline;
        b[0] = smooth ? (p[0] + 4.0f * p[1] + p[2]) / 6.0f : p[1];
        b[stride] = smooth ? (2.0f * p[1] + p[2]) / 3.0f : p[1] + (p[2] - p[0]) / 6.0f;
        b[2 * stride] = smooth ? (p[1] + 2.0f * p[2]) / 3.0f : p[2] - (p[3] - p[1]) / 6.0f;
        b[3 * stride] = smooth ? (p[1] + 4.0f * p[2] + p[3]) / 6.0f : p[2];
      }
    }
  }
  return box;
}

// A trilinear displacement over a box.
struct TrilinearBox
{
  std::array<glm::vec3, 8> corners;
  glm::vec3 perCell;

  // Slope along an axis on the box's edge from a corner.
  glm::vec3 slope(int axis, int corner) const
  {
    return this->perCell[axis] * (this->corners[corner | 1 << axis] - this->corners[corner]);
  }

  ColumnBounds columns() const
  {
    ColumnBounds result;
    for (int axis = 0; axis < 3; ++axis)
    {
      const int a = 1 << (axis + 1) % 3;
      const int b = 1 << (axis + 2) % 3;
      const glm::vec3 edges[4] = { this->slope(axis, 0), this->slope(axis, a), this->slope(axis, b),
        this->slope(axis, a | b) };
      result.middle[axis] = 0.25f * (edges[0] + edges[1] + edges[2] + edges[3]);
      result.middle[axis][axis] += 1.0f;
      result.slope[axis] = glm::mat3(0.0f);
      result.slope[axis][(axis + 1) % 3] = 0.5f * (edges[1] + edges[3] - edges[0] - edges[2]);
      result.slope[axis][(axis + 2) % 3] = 0.5f * (edges[2] + edges[3] - edges[0] - edges[1]);
      result.rest[axis] = 0.25f * glm::abs(edges[0] + edges[3] - edges[1] - edges[2]);
    }
    return result;
  }

  float determinantAtCorner(bool last) const
  {
    glm::mat3 jacobian(1.0f);
    for (int axis = 0; axis < 3; ++axis)
    {
      jacobian[axis] += this->slope(axis, last ? 7 & ~(1 << axis) : 0);
    }
    return glm::determinant(jacobian);
  }

  TrilinearBox split(int axis)
  {
    this->perCell[axis] *= 2.0f;
    TrilinearBox upper = *this;
    for (int corner = 0; corner < 8; ++corner)
    {
      if (!(corner >> axis & 1))
      {
        const int other = corner | 1 << axis;
        const glm::vec3 middle = 0.5f * (this->corners[corner] + this->corners[other]);
        this->corners[other] = middle;
        upper.corners[corner] = middle;
      }
    }
    return upper;
  }
};

// Proves a box, or its halves one by one. `boxes` counts down what may still be tried.
template <typename Box>
bool holds(Box& box, int axis, float limit, int& boxes)
{
  if (leastDeterminant(box.columns()) >= limit)
  {
    return true;
  }
  if (--boxes < 0 || box.determinantAtCorner(false) < limit ||
    box.determinantAtCorner(true) < limit)
  {
    return false;
  }
  Box upper = box.split(axis);
  const int next = (axis + 1) % 3;
  return holds(box, next, limit, boxes) && holds(upper, next, limit, boxes);
}

// Range of a product of two numbers.
glm::vec2 product(const glm::vec2& a, const glm::vec2& b)
{
  const glm::vec4 corners(a.x * b.x, a.x * b.y, a.y * b.x, a.y * b.y);
  return { glm::min(glm::min(corners.x, corners.y), glm::min(corners.z, corners.w)),
    glm::max(glm::max(corners.x, corners.y), glm::max(corners.z, corners.w)) };
}
}

float leastDeterminant(const ColumnBounds& columns)
{
  // The determinant is linear in each column: expand middle + change, and take each term at its
  // worst; those of first order along each axis together.
  const glm::vec3* m = columns.middle;
  glm::vec3 r[3]; // largest change
  glm::vec3 firstOrder(0.0f);
  float least = glm::dot(m[0], glm::cross(m[1], m[2]));
  for (int a = 0; a < 3; ++a)
  {
    const glm::mat3& slope = columns.slope[a];
    r[a] = 0.5f * (glm::abs(slope[0]) + glm::abs(slope[1]) + glm::abs(slope[2])) + columns.rest[a];
    const glm::vec3 cofactors = glm::cross(m[(a + 1) % 3], m[(a + 2) % 3]);
    firstOrder += cofactors * slope; // the change along each axis
    least -= glm::dot(columns.rest[a], glm::abs(cofactors));
  }
  least -= 0.5f * (std::abs(firstOrder.x) + std::abs(firstOrder.y) + std::abs(firstOrder.z));
  for (int a = 0; a < 3; ++a)
  {
    least -= glm::dot(glm::abs(m[a]), largestCross(r[(a + 1) % 3], r[(a + 2) % 3]));
  }
  return least - glm::dot(r[0], largestCross(r[1], r[2]));
}

void holdFace(CellTaps& taps, int kernel, int axis, int side)
{
  const glm::vec4 weight = kernelWeights(kernel, static_cast<float>(side));
  const int stride = Stride[axis];
  for (auto& component : taps.component)
  {
    for (int row = 0; row < 16; ++row)
    {
      float* tap = component.data() + rowStart(axis, row);
      const float face = weight[0] * tap[0] + weight[1] * tap[stride] +
        weight[2] * tap[2 * stride] + weight[3] * tap[3 * stride];
      for (int i = 0; i < 4; ++i)
      {
        tap[i * stride] = face;
      }
    }
  }
}

ColumnBounds boundsOf(const CellTaps& taps, int kernel)
{
  return cubicOf(taps, kernel).hull();
}

ColumnBounds maskedBoundsOf(const CellTaps& taps, int kernel, const WeightRange& weights)
{
  const CubicBox cubic = cubicOf(taps, kernel);
  ColumnBounds result = cubic.hull();
  for (int component = 0; component < 3; ++component)
  {
    const auto& values = cubic.coefficients.component[component];
    const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
    for (int axis = 0; axis < 3; ++axis)
    {
      // A difference of products between nodes: weight * difference + weight's difference * value.
      const float identity = axis == component ? 1.0f : 0.0f;
      const float slope = result.middle[axis][component] - identity;
      const float rest = result.rest[axis][component];
      const glm::vec2 sum =
        product({ weights.least, weights.greatest }, { slope - rest, slope + rest }) +
        product({ weights.leastSlope[axis], weights.greatestSlope[axis] }, { *least, *greatest });
      result.middle[axis][component] = identity + 0.5f * (sum.x + sum.y);
      result.rest[axis][component] = 0.5f * (sum.y - sum.x);
    }
  }
  return result;
}

bool cubicHolds(const CellTaps& taps, int kernel, float limit)
{
  CubicBox box = cubicOf(taps, kernel);
  int boxes = LargestBoxes;
  return holds(box, 0, limit, boxes);
}

bool trilinearHolds(const std::array<glm::vec3, 8>& corners, int perCell, float limit)
{
  TrilinearBox box{ corners, glm::vec3(static_cast<float>(perCell)) };
  int boxes = LargestBoxes;
  return holds(box, 0, limit, boxes);
}
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Deformation/JacobianBound.h"

#include "Filters/Deformation/Kernels.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace brainshift
{
namespace
{
constexpr int LargestBoxes = 2000;      // for a proof; where they do not do, it counts as failed
constexpr int Stride[3] = { 1, 4, 16 }; // to the next control point along an axis

template <typename T>
using Vector = glm::vec<3, T>;
template <typename T>
using Matrix = glm::mat<3, 3, T>;

// |a x b| when the signs of all numbers are the worst.
template <typename T>
Vector<T> largestCross(const Vector<T>& a, const Vector<T>& b)
{
  return { a.y * b.z + a.z * b.y, a.z * b.x + a.x * b.z, a.x * b.y + a.y * b.x };
}

template <typename T>
T leastOf(const ColumnBoundsOf<T>& columns)
{
  // The determinant is linear in each column: expand middle + change, and take each term at its
  // worst; those of first order along each axis together.
  const Vector<T>* m = columns.middle;
  Vector<T> r[3]; // largest change
  Vector<T> firstOrder(T(0));
  T least = glm::dot(m[0], glm::cross(m[1], m[2]));
  for (int a = 0; a < 3; ++a)
  {
    const Matrix<T>& slope = columns.slope[a];
    r[a] =
      T(0.5) * (glm::abs(slope[0]) + glm::abs(slope[1]) + glm::abs(slope[2])) + columns.rest[a];
    const Vector<T> cofactors = glm::cross(m[(a + 1) % 3], m[(a + 2) % 3]);
    firstOrder += cofactors * slope; // the change along each axis
    least -= glm::dot(columns.rest[a], glm::abs(cofactors));
  }
  least -= T(0.5) * (std::abs(firstOrder.x) + std::abs(firstOrder.y) + std::abs(firstOrder.z));
  for (int a = 0; a < 3; ++a)
  {
    least -= glm::dot(glm::abs(m[a]), largestCross<T>(r[(a + 1) % 3], r[(a + 2) % 3]));
  }
  return least - glm::dot(r[0], largestCross<T>(r[1], r[2]));
}

// Index of the first control point of one of the 16 rows along an axis.
int rowStart(int axis, int row)
{
  const int low = row & 3;
  const int high = row >> 2;
  return axis == 0 ? 4 * low + 16 * high : axis == 1 ? low + 16 * high : low + 4 * high;
}

template <typename T>
struct LinearRange
{
  T middle;
  Vector<T> slope; // across the box
  T rest;          // at most, to either side
};

// A linear function near a cubic's derivative along an axis (times the box's size / 3), and how far
// off it is. The derivative's Bernstein coefficients lie at regular places in the box; what is left
// of them is a bound on what is left of it.
template <typename T>
LinearRange<T> linearRange(const T* value, int axis)
{
  const int own = Stride[axis];
  const auto difference = [&](int at) { return value[at + own] - value[at]; };
  const int last[3] = { axis == 0 ? 2 : 3, axis == 1 ? 2 : 3, axis == 2 ? 2 : 3 };
  LinearRange<T> range{ T(0), Vector<T>(T(0)), T(0) };
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::ivec3 side(corner & 1, corner >> 1 & 1, corner >> 2);
    const T at = T(0.125) *
      difference(side.x * last[0] + side.y * last[1] * Stride[1] + side.z * last[2] * Stride[2]);
    range.middle += at;
    range.slope += at * Vector<T>(4 * side - 2);
  }
  const Vector<T> step(range.slope.x / last[0], range.slope.y / last[1], range.slope.z / last[2]);
  T least = T(0.0);
  T greatest = T(0.0);
  for (int k = 0; k <= last[2]; ++k)
  {
    for (int j = 0; j <= last[1]; ++j)
    {
      T linear = range.middle - T(0.5) * (range.slope.x + range.slope.y + range.slope.z) +
        static_cast<T>(j) * step.y + static_cast<T>(k) * step.z;
      for (int i = 0; i <= last[0]; ++i, linear += step.x)
      {
        const T left = difference(i + j * Stride[1] + k * Stride[2]) - linear;
        least = left < least ? left : least;
        greatest = left > greatest ? left : greatest;
      }
    }
  }
  range.middle += T(0.5) * (least + greatest);
  range.rest = T(0.5) * (greatest - least);
  return range;
}

// Least and greatest difference between neighbours along an axis.
template <typename T>
std::pair<T, T> differences(const T* value, int axis)
{
  const int stride = Stride[axis];
  T least = value[stride] - value[0];
  T greatest = least;
  for (int row = 0; row < 16; ++row)
  {
    const T* at = value + rowStart(axis, row);
    for (int step = 0; step < 3; ++step, at += stride)
    {
      const T difference = at[stride] - at[0];
      least = difference < least ? difference : least;
      greatest = difference > greatest ? difference : greatest;
    }
  }
  return { least, greatest };
}

// A cubic in Bernstein form over a box.
template <typename T>
struct CubicBox
{
  CellTapsOf<T> coefficients;
  Vector<T> perCell{ T(1) }; // such boxes in a lattice cell along each axis

  ColumnBoundsOf<T> columns() const
  {
    ColumnBoundsOf<T> result;
    for (int axis = 0; axis < 3; ++axis)
    {
      for (int component = 0; component < 3; ++component)
      {
        const LinearRange<T> range =
          linearRange(this->coefficients.component[component].data(), axis);
        const T scale = T(3.0) * this->perCell[axis];
        result.middle[axis][component] =
          scale * range.middle + (axis == component ? T(1.0) : T(0.0));
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
  ColumnBoundsOf<T> hull() const
  {
    ColumnBoundsOf<T> result;
    for (int axis = 0; axis < 3; ++axis)
    {
      const T scale = T(3.0) * this->perCell[axis];
      for (int component = 0; component < 3; ++component)
      {
        const auto [least, greatest] =
          differences(this->coefficients.component[component].data(), axis);
        result.middle[axis][component] =
          T(0.5) * scale * (least + greatest) + (axis == component ? T(1.0) : T(0.0));
        result.rest[axis][component] = T(0.5) * scale * (greatest - least);
      }
      result.slope[axis] = Matrix<T>(T(0.0));
    }
    return result;
  }

  // At the first corner, or at the last.
  T determinantAtCorner(bool last) const
  {
    Matrix<T> jacobian(T(1.0));
    for (int axis = 0; axis < 3; ++axis)
    {
      const int to = last ? 63 : Stride[axis];
      const int from = to - Stride[axis];
      for (int component = 0; component < 3; ++component)
      {
        const auto& value = this->coefficients.component[component];
        jacobian[axis][component] += T(3.0) * this->perCell[axis] * (value[to] - value[from]);
      }
    }
    return glm::determinant(jacobian);
  }

  // Largest change, along an axis, of a difference along any axis: 0 if halving is of no use.
  T curvature(int axis) const
  {
    T largest = T(0);
    for (int other = 0; other < 3; ++other)
    {
      glm::ivec3 last(3);
      --last[axis];
      --last[other];
      const int a = Stride[axis];
      const int b = Stride[other];
      for (const auto& value : this->coefficients.component)
      {
        for (int i = 0; i < 64; ++i)
        {
          if ((i & 3) <= last.x && (i >> 2 & 3) <= last.y && (i >> 4) <= last.z)
          {
            const T second = value[i + a + b] - value[i + a] - value[i + b] + value[i];
            largest = std::max(largest, std::abs(second) * this->perCell[other]);
          }
        }
      }
    }
    return largest;
  }

  // Halves along an axis: this becomes the lower half, the upper one is returned.
  CubicBox split(int axis)
  {
    this->perCell[axis] *= T(2.0);
    CubicBox upper = *this;
    const int stride = Stride[axis];
    for (int component = 0; component < 3; ++component)
    {
      for (int row = 0; row < 16; ++row)
      {
        T* low = this->coefficients.component[component].data() + rowStart(axis, row);
        T* high = upper.coefficients.component[component].data() + rowStart(axis, row);
        const T first = T(0.5) * (low[0] + low[stride]);
        const T middle = T(0.5) * (low[stride] + low[2 * stride]);
        const T last = T(0.5) * (low[2 * stride] + low[3 * stride]);
        const T below = T(0.5) * (first + middle);
        const T above = T(0.5) * (middle + last);
        low[stride] = first;
        low[2 * stride] = below;
        low[3 * stride] = T(0.5) * (below + above);
        high[0] = low[3 * stride];
        high[stride] = above;
        high[2 * stride] = last;
      }
    }
    return upper;
  }
};

// Bernstein coefficients of the kernel's cubic between the second and the third control point.
template <typename T>
CubicBox<T> cubicOf(const CellTapsOf<T>& taps, int kernel)
{
  CubicBox<T> box;
  box.coefficients = taps;
  for (auto& component : box.coefficients.component)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const int stride = Stride[axis];
      for (int row = 0; row < 16; ++row)
      {
        T* b = component.data() + rowStart(axis, row);
        const T p[4] = { b[0], b[stride], b[2 * stride], b[3 * stride] };
        const bool smooth = kernel == KernelBSpline;
        b[0] = smooth ? (p[0] + T(4.0) * p[1] + p[2]) / T(6.0) : p[1];
        b[stride] = smooth ? (T(2.0) * p[1] + p[2]) / T(3.0) : p[1] + (p[2] - p[0]) / T(6.0);
        b[2 * stride] = smooth ? (p[1] + T(2.0) * p[2]) / T(3.0) : p[2] - (p[3] - p[1]) / T(6.0);
        b[3 * stride] = smooth ? (p[1] + T(4.0) * p[2] + p[3]) / T(6.0) : p[2];
      }
    }
  }
  return box;
}

// A trilinear displacement over a box.
template <typename T>
struct TrilinearBox
{
  std::array<Vector<T>, 8> corners;
  Vector<T> perCell;

  // Slope along an axis on the box's edge from a corner.
  Vector<T> slope(int axis, int corner) const
  {
    return this->perCell[axis] * (this->corners[corner | 1 << axis] - this->corners[corner]);
  }

  ColumnBoundsOf<T> columns() const
  {
    ColumnBoundsOf<T> result;
    for (int axis = 0; axis < 3; ++axis)
    {
      const int a = 1 << (axis + 1) % 3;
      const int b = 1 << (axis + 2) % 3;
      const Vector<T> edges[4] = { this->slope(axis, 0), this->slope(axis, a), this->slope(axis, b),
        this->slope(axis, a | b) };
      result.middle[axis] = T(0.25) * (edges[0] + edges[1] + edges[2] + edges[3]);
      result.middle[axis][axis] += T(1.0);
      result.slope[axis] = Matrix<T>(T(0.0));
      result.slope[axis][(axis + 1) % 3] = T(0.5) * (edges[1] + edges[3] - edges[0] - edges[2]);
      result.slope[axis][(axis + 2) % 3] = T(0.5) * (edges[2] + edges[3] - edges[0] - edges[1]);
      result.rest[axis] = T(0.25) * glm::abs(edges[0] + edges[3] - edges[1] - edges[2]);
    }
    return result;
  }

  T determinantAtCorner(bool last) const
  {
    Matrix<T> jacobian(T(1.0));
    for (int axis = 0; axis < 3; ++axis)
    {
      jacobian[axis] += this->slope(axis, last ? 7 & ~(1 << axis) : 0);
    }
    return glm::determinant(jacobian);
  }

  // As of a CubicBox.
  T curvature(int axis) const
  {
    T largest = T(0);
    for (int other = 0; other < 3; ++other)
    {
      for (int corner = 0; corner < 8 && other != axis; ++corner)
      {
        const Vector<T> change = glm::abs(this->slope(other, (corner | 1 << axis) & ~(1 << other)) -
          this->slope(other, corner & ~(1 << axis | 1 << other)));
        largest = std::max({ largest, change.x, change.y, change.z });
      }
    }
    return largest;
  }

  TrilinearBox split(int axis)
  {
    this->perCell[axis] *= T(2.0);
    TrilinearBox upper = *this;
    for (int corner = 0; corner < 8; ++corner)
    {
      if (!(corner >> axis & 1))
      {
        const int other = corner | 1 << axis;
        const Vector<T> middle = T(0.5) * (this->corners[corner] + this->corners[other]);
        this->corners[other] = middle;
        upper.corners[corner] = middle;
      }
    }
    return upper;
  }
};

// Proves a box, or its halves one by one. `boxes` counts down what may still be tried. Open boxes
// are on the heap: there may be thousands, and threads of Windows have a stack of 1 MB.
template <typename Box>
bool holds(const Box& whole, int axis, float limit, int& boxes)
{
  struct Open
  {
    Box box;
    int axis;
  };
  if (leastOf(whole.columns()) >= limit)
  {
    return true;
  }
  std::vector<Open> open{ { whole, axis } };
  while (!open.empty())
  {
    Open lower = open.back();
    if (leastOf(lower.box.columns()) >= limit)
    {
      open.pop_back();
      continue;
    }
    if (--boxes < 0 || lower.box.determinantAtCorner(false) < limit ||
      lower.box.determinantAtCorner(true) < limit)
    {
      return false;
    }
    const int next = (lower.axis + 1) % 3;
    open.back() = { lower.box.split(lower.axis), next };
    lower.axis = next;
    open.push_back(lower);
  }
  return true;
}

template <typename Box>
class PartOf : public DeterminantPart
{
public:
  explicit PartOf(const Box& box)
    : Part(box)
  {
    this->bound();
  }

  std::unique_ptr<DeterminantPart> halve() override
  {
    const std::array<double, 3> bent{ this->Part.curvature(0), this->Part.curvature(1),
      this->Part.curvature(2) };
    const auto axis = std::max_element(bent.begin(), bent.end()) - bent.begin();
    auto upper = std::make_unique<PartOf>(this->Part.split(static_cast<int>(axis)));
    this->bound();
    return upper;
  }

private:
  void bound()
  {
    this->least = leastOf(this->Part.columns());
    this->found =
      std::min(this->Part.determinantAtCorner(false), this->Part.determinantAtCorner(true));
  }

  Box Part;
};

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
  return leastOf(columns);
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
  const CubicBox<float> cubic = cubicOf(taps, kernel);
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
  CubicBox<float> box = cubicOf(taps, kernel);
  int boxes = LargestBoxes;
  return holds(box, 0, limit, boxes);
}

bool trilinearHolds(const std::array<glm::vec3, 8>& corners, int perCell, float limit)
{
  TrilinearBox<float> box{ corners, glm::vec3(static_cast<float>(perCell)) };
  int boxes = LargestBoxes;
  return holds(box, 0, limit, boxes);
}

std::unique_ptr<DeterminantPart> cubicPart(const CellTapsOf<double>& taps, int kernel)
{
  return std::make_unique<PartOf<CubicBox<double>>>(cubicOf(taps, kernel));
}

std::unique_ptr<DeterminantPart> trilinearPart(
  const std::array<glm::dvec3, 8>& corners, int perCell)
{
  return std::make_unique<PartOf<TrilinearBox<double>>>(
    TrilinearBox<double>{ corners, glm::dvec3(perCell) });
}
}

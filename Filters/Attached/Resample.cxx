// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Attached/Resample.h"

#include "Common/Parallel.h"
#include "Filters/Deformation/Kernels.h"

#include "vtkDataArray.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <type_traits>

namespace brainshift
{
namespace
{
// Voxels around a position that are held before it is read: more than any reading takes.
constexpr int Taps = 2;

// A position this far outside the voxels still counts as the border: single precision's part.
constexpr float BorderTolerance = 1e-3f; // voxels

template <typename T>
T fromReal(double value)
{
  if constexpr (std::is_integral<T>::value)
  {
    const double low = static_cast<double>(std::numeric_limits<T>::lowest());
    const double high = static_cast<double>(std::numeric_limits<T>::max());
    if constexpr (sizeof(T) <= 2)
    {
      // Cut to a whole number above the lowest: floor is a call on processors before SSE 4.1.
      const double aboveLow = std::min(std::max(value - low + 0.5, 0.0), high - low);
      return static_cast<T>(static_cast<int>(aboveLow) + std::numeric_limits<T>::lowest());
    }
    const double rounded = std::floor(value + 0.5);
    return rounded <= low ? std::numeric_limits<T>::lowest()
      : rounded >= high   ? std::numeric_limits<T>::max()
                          : static_cast<T>(rounded);
  }
  else
  {
    return static_cast<T>(value);
  }
}

// The source array and how to read it at a fractional index.
template <typename T>
class Voxels
{
public:
  Voxels(const T* values, int components, const ResampleGeometry& geometry)
    : Values(values)
    , Components(components)
    , Dimensions(geometry.dimensions)
    , StrideY(static_cast<std::ptrdiff_t>(components) * geometry.held.size().x)
    , StrideZ(StrideY * geometry.held.size().y)
  {
    const IndexBox& held = geometry.held;
    this->First = this->offset(held.first);
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (int axis = 0; axis < 3; ++axis)
    {
      const bool isLast = held.last[axis] >= this->Dimensions[axis] - 1;
      this->Low[axis] = held.first[axis] <= 0 ? -infinity : float(held.first[axis] + Taps);
      this->High[axis] = isLast ? infinity : float(held.last[axis] - Taps);
    }
  }

  const T* at(const glm::ivec3& index) const
  {
    return this->Values + (this->offset(index) - this->First);
  }

  // Whether all that is read at a position within the volume is held.
  bool holds(const glm::vec3& position) const
  {
    return glm::all(glm::greaterThanEqual(position, this->Low)) &&
      glm::all(glm::lessThanEqual(position, this->High));
  }

  // What is to be held so that a position can be read.
  IndexBox around(const glm::vec3& position) const
  {
    const glm::ivec3 low(glm::floor(position));
    return { glm::clamp(low - Taps - 1, glm::ivec3(0), this->Dimensions - 1),
      glm::clamp(low + Taps + 2, glm::ivec3(0), this->Dimensions - 1) };
  }

  bool contains(const glm::vec3& position) const
  {
    return glm::all(glm::greaterThanEqual(position, glm::vec3(-BorderTolerance))) &&
      glm::all(glm::lessThanEqual(position, glm::vec3(this->Dimensions - 1) + BorderTolerance));
  }

  void read(Reading reading, const glm::vec3& position, T* out) const
  {
    switch (reading)
    {
      case Reading::Nearest:
        return this->nearest(position, out);
      case Reading::Linear:
        return this->linear(position, out);
      case Reading::Cubic:
        return this->cubic(position, out);
    }
  }

private:
  std::ptrdiff_t offset(const glm::ivec3& index) const
  {
    return index.z * this->StrideZ + index.y * this->StrideY +
      static_cast<std::ptrdiff_t>(index.x) * this->Components;
  }

  void nearest(const glm::vec3& position, T* out) const
  {
    const glm::ivec3 index =
      glm::clamp(glm::ivec3(glm::floor(position + 0.5f)), glm::ivec3(0), this->Dimensions - 1);
    std::copy_n(this->at(index), this->Components, out);
  }

  void linear(const glm::vec3& position, T* out) const
  {
    const glm::vec3 inside = glm::clamp(position, glm::vec3(0.0f), glm::vec3(this->Dimensions - 1));
    const glm::ivec3 low = glm::min(glm::ivec3(inside), glm::max(this->Dimensions - 2, 0));
    const glm::vec3 w = inside - glm::vec3(low);
    const glm::ivec3 next = glm::min(this->Dimensions - 1 - low, glm::ivec3(1));
    const std::ptrdiff_t x = static_cast<std::ptrdiff_t>(next.x) * this->Components;
    const std::ptrdiff_t y = next.y * this->StrideY;
    const std::ptrdiff_t z = next.z * this->StrideZ;
    const T* v = this->at(low);
    for (int c = 0; c < this->Components; ++c, ++v)
    {
      out[c] = fromReal<T>(mix(mix(mix(v[0], v[x], w.x), mix(v[y], v[y + x], w.x), w.y),
        mix(mix(v[z], v[z + x], w.x), mix(v[z + y], v[z + y + x], w.x), w.y), w.z));
    }
  }

  void cubic(const glm::vec3& position, T* out) const
  {
    const glm::vec3 inside = glm::clamp(position, glm::vec3(0.0f), glm::vec3(this->Dimensions - 1));
    const glm::ivec3 low(inside);
    const glm::vec3 w = inside - glm::vec3(low);
    const glm::vec4 weight[3] = { kernelWeights(KernelCatmullRom, w.x),
      kernelWeights(KernelCatmullRom, w.y), kernelWeights(KernelCatmullRom, w.z) };
    for (int c = 0; c < this->Components; ++c)
    {
      double sum = 0.0;
      for (int tap = 0; tap < 64; ++tap)
      {
        const glm::ivec3 step(tap & 3, tap >> 2 & 3, tap >> 4);
        const glm::ivec3 index = glm::clamp(low + step - 1, glm::ivec3(0), this->Dimensions - 1);
        sum += static_cast<double>(weight[0][step.x] * weight[1][step.y] * weight[2][step.z]) *
          static_cast<double>(this->at(index)[c]);
      }
      out[c] = fromReal<T>(sum);
    }
  }

  // Double for types whose values a float cannot hold.
  using Real = typename std::conditional<(sizeof(T) < 4), float, double>::type;
  template <typename A, typename B>
  static Real mix(A a, B b, float t)
  {
    return static_cast<Real>(a) + (static_cast<Real>(b) - static_cast<Real>(a)) * t;
  }

  const T* Values;
  int Components;
  glm::ivec3 Dimensions;
  std::ptrdiff_t StrideY;
  std::ptrdiff_t StrideZ;
  std::ptrdiff_t First; // of the held ones
  glm::vec3 Low;        // positions that can be read are from here
  glm::vec3 High;       // to here
};

// The first guess along one row of voxels: nodes blended across y and z once, so that a voxel costs
// one blend along x.
class OffsetRow
{
public:
  void set(const NodeField& field, float latticeY, float latticeZ)
  {
    const FieldNodes& nodes = field.nodes;
    const glm::vec2 last(nodes.count.y - 1, nodes.count.z - 1);
    const glm::vec2 node =
      glm::clamp((glm::vec2(latticeY, latticeZ) - glm::vec2(nodes.first.y, nodes.first.z)) *
          static_cast<float>(nodes.perCell),
        glm::vec2(0.0f), last);
    const glm::ivec2 low(node);
    const glm::ivec2 high = glm::min(low + 1, glm::ivec2(last));
    const glm::vec2 w = node - glm::vec2(low);
    const auto row = [&](int y, int z) {
      return &field.values[(static_cast<std::size_t>(z) * nodes.count.y + y) * nodes.count.x];
    };
    const glm::vec3* rows[4] = { row(low.x, low.y), row(high.x, low.y), row(low.x, high.y),
      row(high.x, high.y) };
    this->Nodes.resize(nodes.count.x);
    constexpr float infinity = std::numeric_limits<float>::infinity();
    this->MovedFrom = infinity;
    this->MovedTo = -infinity;
    for (int x = 0; x < nodes.count.x; ++x)
    {
      this->Nodes[x] =
        glm::mix(glm::mix(rows[0][x], rows[1][x], w.x), glm::mix(rows[2][x], rows[3][x], w.x), w.y);
      // Not their blend, which may cancel where the cubic does not.
      if (std::any_of(rows, rows + 4, [&](auto* nodes) { return nodes[x] != glm::vec3(0.0f); }))
      {
        this->MovedFrom = std::min(this->MovedFrom, x - 1.0f);
        this->MovedTo = x + 1.0f;
      }
    }
    // Beyond the nodes the last one holds.
    this->MovedFrom = this->MovedFrom < 0.0f ? -infinity : this->MovedFrom;
    this->MovedTo = this->MovedTo >= static_cast<float>(nodes.count.x) ? infinity : this->MovedTo;
  }

  // Nodes between which offsets may differ from zero; none if from > to.
  float movedFrom() const { return this->MovedFrom; }
  float movedTo() const { return this->MovedTo; }

  glm::vec3 at(float node) const
  {
    const int last = static_cast<int>(this->Nodes.size()) - 1;
    const float inside = std::clamp(node, 0.0f, static_cast<float>(last));
    const int low = std::min(static_cast<int>(inside), std::max(last - 1, 0));
    return glm::mix(this->Nodes[low], this->Nodes[std::min(low + 1, last)], inside - low);
  }

private:
  std::vector<glm::vec3> Nodes;
  float MovedFrom = 0.0f;
  float MovedTo = 0.0f;
};

template <typename T>
std::vector<T> numbersOf(const std::vector<double>& lowest)
{
  std::vector<T> numbers;
  numbers.reserve(lowest.size());
  for (const double value : lowest)
  {
    numbers.push_back(std::isfinite(value) ? fromReal<T>(value) : T(0));
  }
  return numbers;
}

// The array to read, and what it has outside.
template <typename T>
struct Source
{
  Voxels<T> voxels;
  std::vector<T> outside; // one value for each component
};

// Writes one row of the target; `index` is its first voxel. Positions count from the row's first
// voxel in the whole volume, so that they are the same in each part.
template <typename T>
Lacking resampleRow(
  const Source<T>& source, const Resampling& how, OffsetRow& row, const glm::ivec3& index, T* out)
{
  Lacking lacking;
  const Voxels<T>& voxels = source.voxels;
  const auto components = static_cast<std::ptrdiff_t>(source.outside.size());
  const ResampleGeometry& geometry = how.geometry;
  const BackwardMap& backward = how.backward;
  const glm::dvec3 lattice =
    glm::dvec3(0, index.y, index.z) * geometry.latticeFromIndex + geometry.latticeOfFirst;
  const int length = geometry.dimensions.x;
  const int end = geometry.written.last.x + 1;
  const FieldNodes& nodes = backward.firstGuess.nodes;
  row.set(backward.firstGuess, static_cast<float>(lattice.y), static_cast<float>(lattice.z));
  const glm::vec3 indexFromCells(1.0 / geometry.latticeFromIndex);
  const float nodeStep = static_cast<float>(geometry.latticeFromIndex.x * nodes.perCell);
  const float firstNode = static_cast<float>((lattice.x - nodes.first.x) * nodes.perCell);
  const auto voxelOf = [&](float node) {
    return static_cast<int>(
      glm::clamp((node - firstNode) / nodeStep, 0.0f, static_cast<float>(length)));
  };
  const int moved = glm::clamp(voxelOf(row.movedFrom()), index.x, end);
  const int still = glm::clamp(voxelOf(row.movedTo()) + 2, moved, end);
  out = std::copy_n(voxels.at(index), (moved - index.x) * components, out);
  for (int i = moved; i < still; ++i, out += components)
  {
    const glm::dvec3 deformed(lattice.x + i * geometry.latticeFromIndex.x, lattice.y, lattice.z);
    const glm::vec3 offset = backward.map.offsetInCells(deformed, row.at(firstNode + i * nodeStep));
    const glm::vec3 position = glm::vec3(i, index.y, index.z) + offset * indexFromCells;
    const bool isInside = voxels.contains(position);
    if (isInside && voxels.holds(position))
    {
      voxels.read(how.reading, position, out);
    }
    else
    {
      lacking.add({ isInside ? voxels.around(position) : IndexBox{}, !isInside, false });
      std::copy(source.outside.begin(), source.outside.end(), out);
    }
  }
  std::copy_n(voxels.at({ still, index.y, index.z }), (end - still) * components, out);
  return lacking;
}

constexpr vtkIdType VoxelsInTime = 2000000;

template <typename T>
Lacking resampleTyped(vtkDataArray* array, vtkDataArray* target, const std::vector<double>& outside,
  const Resampling& how)
{
  const ResampleGeometry& geometry = how.geometry;
  const int components = array->GetNumberOfComponents();
  const Source<T> source{ { static_cast<const T*>(array->GetVoidPointer(0)), components, geometry },
    numbersOf<T>(outside) };
  const glm::ivec3 size = geometry.written.size();
  const glm::ivec3 targetSize = geometry.target.size();
  T* const out = static_cast<T*>(target->GetVoidPointer(0));
  const auto outAt = [&](const glm::ivec3& index) {
    const glm::ivec3 from = index - geometry.target.first;
    const vtkIdType row = static_cast<vtkIdType>(from.z) * targetSize.y + from.y;
    return out + (row * targetSize.x + from.x) * components;
  };
  const vtkIdType rows = size.x > 0 ? static_cast<vtkIdType>(size.y) * size.z : 0;
  // Between two reports of progress: at least 256, about a tenth of a second where rows are long.
  const vtkIdType rowsInTime = VoxelsInTime / std::max<vtkIdType>(size.x, 1);
  const vtkIdType rowsAtOnce = std::max<vtkIdType>(std::min(rows / 20, rowsInTime), 256);
  Lacking lacking;
  std::mutex mutex;
  for (vtkIdType done = 0; done < rows; done += rowsAtOnce)
  {
    if (!how.proceed(static_cast<double>(done) / rows))
    {
      lacking.stopped = true;
      return lacking;
    }
    const vtkIdType next = std::min(done + rowsAtOnce, rows);
    parallelFor(done, next, 64, [&](vtkIdType begin, vtkIdType end) {
      OffsetRow offsetRow;
      Lacking ofRows;
      for (vtkIdType row = begin; row < end; ++row)
      {
        const glm::ivec3 index = geometry.written.first +
          glm::ivec3(0, static_cast<int>(row % size.y), static_cast<int>(row / size.y));
        ofRows.add(resampleRow(source, how, offsetRow, index, outAt(index)));
      }
      const std::lock_guard<std::mutex> lock(mutex);
      lacking.add(ofRows);
    });
  }
  return lacking;
}
}

void Lacking::add(const Lacking& other)
{
  this->voxels = enclosing(this->voxels, other.voxels);
  this->outside = this->outside || other.outside;
  this->stopped = this->stopped || other.stopped;
}

std::vector<double> lowestOf(vtkDataArray* array)
{
  std::vector<double> lowest;
  for (int component = 0; component < array->GetNumberOfComponents(); ++component)
  {
    double range[2];
    array->GetFiniteRange(range, component);
    lowest.push_back(range[0] <= range[1] ? range[0] : std::numeric_limits<double>::infinity());
  }
  return lowest;
}

BackwardMap::BackwardMap(const Lattice& lattice, int samples, Inverse inverse)
  : map(lattice, inverse)
  , firstGuess(offsetField(lattice, lattice.mask ? samples : std::max(samples, 2), inverse))
{
  // Two samples: a tricubic that is zero at the 64 nodes of a lattice cell is zero within it.
}

Lacking resample(vtkDataArray* source, vtkDataArray* target, const std::vector<double>& outside,
  const Resampling& how)
{
  Lacking lacking;
  switch (source->GetDataType())
  {
    vtkTemplateMacro(lacking = resampleTyped<VTK_TT>(source, target, outside, how));
  }
  return lacking;
}
}

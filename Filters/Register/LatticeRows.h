// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Reads a lattice at the samples of a level, row after row, and adds the force of each sample to
/// the control points that it depends on.
///
/// Samples are those of a grid over the volume, each moved by up to half a step: samples on one
/// raster prefer displacements of half a step, where interpolation is smoothest. The shift along z
/// is one for each slab, along y one for each row, along x one for each sample, so that the lattice
/// is blended once for each slab and row.
#ifndef BrainShift_LatticeRows_h
#define BrainShift_LatticeRows_h

#include "Common/Parallel.h"
#include "Filters/Deformation/Kernels.h"
#include "Filters/Deformation/Lattice.h"

#include <algorithm>

namespace brainshift
{
/** Displacements of the control points: mm along the grid's axes. */
using Controls = std::vector<glm::vec3>;

/** Numbers of a force: 3 along the axes, then its Hessian xx yy zz xy xz yz. */
constexpr int ForceNumbers = 9;

/** The force on each control point, summed over the samples. */
using ControlForces = std::vector<float>; // ForceNumbers for each, x fastest

/** How much the samples tell of the position of a control point, from its force. */
inline double weightOf(const float* force)
{
  return static_cast<double>(force[3]) + force[4] + force[5];
}

/** The four control points around a position along one axis, and their weights. */
struct Taps
{
  int first = 0; ///< the first of the four, in a row with one more point at each end
  glm::vec4 weights{ 0.0f };
};

/** A row of samples, for its visitor. */
struct SampleRow
{
  int j = 0;
  int k = 0;
  const glm::vec3* controls = nullptr; ///< of the row, with one more at each end
  float* sums = nullptr;               ///< to add to: ForceNumbers for each of `controls`
};

class BRAINSHIFT_DEFORMATION_EXPORT LatticeRows
{
public:
  LatticeRows() = default;

  /**
   * @param lattice   over the volume's box; its displacements do not count
   * @param samples   a grid with the same axes as the lattice, within its box
   */
  LatticeRows(const Lattice& lattice, const Grid& samples);

  const Grid& samples() const { return this->Samples; }

  /** Offset of a sample from the grid's point, in steps, -0.5 to 0.5 along each axis. */
  glm::vec3 shift(int i, int j, int k) const
  {
    // Multiples of irrational numbers spread evenly.
    return { centred(0.6180340 * i + 0.7548777 * j + 0.5698403 * k),
      centred(0.6180340 * j + 0.7548777 * k), centred(0.6180340 * k) };
  }

  /** Position of a sample, in points of the samples' grid. */
  glm::vec3 position(int i, int j, int k) const
  {
    return glm::vec3(i, j, k) + this->shift(i, j, k);
  }

  /** A position (points of the samples' grid) in coordinates of the lattice. */
  glm::vec3 latticePosition(const glm::vec3& position) const
  {
    return this->AtFirst + position * this->ControlsPerStep;
  }

  /** The control points around a position (points of the samples' grid) along an axis. */
  Taps tapsAt(int axis, float position) const
  {
    const int last = this->Controls[axis] - 1;
    const float at = glm::clamp(
      this->AtFirst[axis] + position * this->ControlsPerStep[axis], 0.0f, static_cast<float>(last));
    const int cell = std::min(static_cast<int>(at), last - 1);
    return { cell, kernelWeights(this->Kernel, at - static_cast<float>(cell)) };
  }

  /** The displacement of a sample of a row (mm along the grid's axes). */
  static glm::vec3 displacement(const SampleRow& row, const Taps& taps)
  {
    const glm::vec3* c = row.controls + taps.first;
    const glm::vec4& w = taps.weights;
    return w.x * c[0] + w.y * c[1] + w.z * c[2] + w.w * c[3];
  }

  /**
   * Adds ForceNumbers numbers of a sample to its row. The Hessian is lumped by sums of its rows, as
   * mass matrices of finite elements are: a control point gets the Hessian of all of them moving
   * together. That is never below the true one, so that a step never overshoots by coupling.
   */
  static void add(const SampleRow& row, const Taps& taps, const float* force);

  /**
   * Calls visit(row) for each row with samples, slabs on several cores, and returns the forces.
   *
   * @param displacements   of the control points, mm along the grid's axes
   * @param hasSamples      of (j, k): whether the row has some
   * @param visit           whether it added to the row's sums
   */
  template <typename HasSamples, typename Visit>
  ControlForces visitRows(const std::vector<glm::vec3>& displacements, const HasSamples& hasSamples,
    const Visit& visit) const
  {
    std::vector<float> slabs(this->slabNumbers() * this->Samples.dimensions.z, 0.0f);
    parallelFor(0, this->Samples.dimensions.z, 1, [&](std::int64_t begin, std::int64_t end) {
      std::vector<glm::vec3> slab;
      std::vector<glm::vec3> controls;
      std::vector<float> sums;
      for (int k = static_cast<int>(begin); k < end; ++k)
      {
        this->blendSlab(displacements, k, slab);
        float* slabSums = &slabs[this->slabNumbers() * k];
        for (int j = 0; j < this->Samples.dimensions.y; ++j)
        {
          if (!hasSamples(j, k))
          {
            continue;
          }
          this->blendRow(slab, j, k, controls);
          sums.assign(controls.size() * ForceNumbers, 0.0f);
          if (visit(SampleRow{ j, k, controls.data(), sums.data() }))
          {
            this->addRow(sums, j, k, slabSums);
          }
        }
      }
    });
    return this->addSlabs(slabs);
  }

  /** Bytes that visitRows takes while it works. */
  static double bytes(const glm::ivec3& controls, const glm::ivec3& samples);

private:
  static float centred(double number)
  {
    // The number is 0 or more, so truncation leaves its fraction.
    return static_cast<float>(
      number - static_cast<double>(static_cast<std::int64_t>(number)) - 0.5);
  }
  std::size_t slabNumbers() const
  {
    return static_cast<std::size_t>(this->Controls.x) * this->Controls.y * ForceNumbers;
  }
  void blendSlab(
    const std::vector<glm::vec3>& displacements, int k, std::vector<glm::vec3>& slab) const;
  void blendRow(
    const std::vector<glm::vec3>& slab, int j, int k, std::vector<glm::vec3>& controls) const;
  void addRow(std::vector<float>& sums, int j, int k, float* slabSums) const;
  ControlForces addSlabs(const std::vector<float>& slabs) const;

  Grid Samples;
  glm::ivec3 Controls{ 0 };
  glm::vec3 ControlsPerStep{ 1.0f };
  glm::vec3 AtFirst{ 0.0f }; // of the first sample's grid point, in the lattice
  int Kernel = 0;
};
}

#endif

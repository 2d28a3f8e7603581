// SPDX-License-Identifier: BSD-3-Clause
// The control points of a free-form deformation and the strokes that move them.
#ifndef BrainShift_Lattice_h
#define BrainShift_Lattice_h

#include "Filters/Deformation/Grid.h"
#include "Filters/Deformation/Stroke.h"
#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include <memory>
#include <vector>

namespace brainshift
{
constexpr int SmallestLatticeSide = 4;  // a cubic kernel spans four control points
constexpr int LargestLatticeSide = 257; // 51 million numbers, 200 MB: more is a dense field

// What share of the displacement holds at each node of a refined field; see MaskWeights.h.
struct NodeWeights
{
  int perCell = 1;           // nodes for each lattice cell
  std::vector<float> values; // 0 to 1, x fastest
};

struct Lattice
{
  Grid grid;      // control points over the volume's box, rest frame
  int kernel = 0; // KernelCatmullRom or KernelBSpline, see Kernels.h
  // float32 x 3 (mm, world axes), one for each control point, x fastest. Zero means stays.
  std::vector<glm::vec3> displacements;
  // Null: all of it moves as the control points say. Else deformedFromRest is the refined field
  // times these weights, trilinear between its nodes.
  std::shared_ptr<const NodeWeights> mask;
};

// The same weights, or none on both sides.
VTKBRAINSHIFTFILTERS_EXPORT bool sameMask(
  const std::shared_ptr<const NodeWeights>& a, const std::shared_ptr<const NodeWeights>& b);

// A lattice of zero displacements.
VTKBRAINSHIFTFILTERS_EXPORT Lattice makeLattice(const Grid& grid, int kernel);

// Moves the control points the stroke reaches. Its weights depend on where the lattice was before,
// never on the stroke's vector. A disabled stroke changes nothing.
VTKBRAINSHIFTFILTERS_EXPORT void applyStroke(Lattice& lattice, const Stroke& stroke);

// The control points' displacements in the lattice's own cells instead of mm along world axes:
// what maps and shaders compute with, since position and displacement then share one unit.
VTKBRAINSHIFTFILTERS_EXPORT std::vector<glm::vec3> displacementsInCells(const Lattice& lattice);

// Displacement at a position in lattice coordinates (cells from the first control point), from the
// 64 control points around it. Outside the lattice the value of its nearest point holds.
VTKBRAINSHIFTFILTERS_EXPORT glm::vec3 cubicDisplacement(const glm::ivec3& dimensions, int kernel,
  const glm::vec3* displacements, const glm::dvec3& position);

// The same with derivatives: column a is the derivative along lattice axis a, 0 along an axis on
// which the position lies outside.
VTKBRAINSHIFTFILTERS_EXPORT glm::mat3 cubicGradient(const glm::ivec3& dimensions, int kernel,
  const glm::vec3* displacements, const glm::dvec3& position);

// Largest displacement of a control point, mm; with a mask, of a node of the refined field.
VTKBRAINSHIFTFILTERS_EXPORT double maximumDisplacement(const Lattice& lattice);

// Smallest Jacobian determinant of deformedFromRest within the lattice, sampled on the control
// points and halfway between them. 1: volume is kept, more: all of it grows, 0 or less: tissue
// folds. Between the samples it can be less; the fold guard does not rely on it. With a mask the
// samples are the corners of all cells between nodes.
VTKBRAINSHIFTFILTERS_EXPORT double minimumJacobian(const Lattice& lattice);
}

#endif

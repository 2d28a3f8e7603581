// SPDX-License-Identifier: BSD-3-Clause
// The surface of tissue in a volume at rest: where its scalars pass a threshold, or where a label
// ends.
#ifndef BrainShift_TissueSurface_h
#define BrainShift_TissueSurface_h

#include "Filters/Deformation/Grid.h"
#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include "vtkSmartPointer.h"

#include <glm/vec3.hpp>

#include <vector>

class vtkDataArray;

namespace brainshift
{
struct TriangleMesh
{
  std::vector<glm::dvec3> points; // mm, world
  std::vector<glm::ivec3> triangles;
};

// Scalars on a grid; those at or above the level are tissue.
struct VTKBRAINSHIFTFILTERS_EXPORT Tissue
{
  Grid grid; // mm, world, rest frame
  vtkSmartPointer<vtkDataArray> scalars;
  double level = 0.0;

  // Trilinear; nothing outside the grid is tissue.
  bool contains(const glm::dvec3& rest) const;
};

// 1 where the labels are `label`, else 0: scalars of a Tissue with level 0.5.
VTKBRAINSHIFTFILTERS_EXPORT vtkSmartPointer<vtkDataArray> maskOfLabel(
  vtkDataArray* labels, int label);

// Triangles where the scalars pass the level; none on the grid's own faces. Triangles beside
// scalars that are not finite are left out.
VTKBRAINSHIFTFILTERS_EXPORT TriangleMesh surfaceOf(const Tissue& tissue);
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief The surface of tissue in a volume at rest: where scalars pass a threshold, or where a
 *        label ends.
 */
#ifndef BrainShift_TissueSurface_h
#define BrainShift_TissueSurface_h

#include "Common/Grid.h"
#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include "vtkSmartPointer.h"

#include <glm/vec3.hpp>

#include <string>
#include <vector>

class vtkDataArray;
class vtkImageData;

namespace brainshift
{
/** Points and the triangles between them. */
struct TriangleMesh
{
  std::vector<glm::dvec3> points;    ///< mm, world
  std::vector<glm::ivec3> triangles; ///< numbers of three points each
};

/** The part of space in which scalars on a grid are at or above a level. */
struct VTKBRAINSHIFTFILTERS_EXPORT TissueRegion
{
  Grid grid;                             ///< mm, world, rest frame
  vtkSmartPointer<vtkDataArray> scalars; ///< one for each point of the grid, x fastest
  double level = 0.0;

  /** Whether a rest position is in the region. Scalars are trilinear; outside the grid: false. */
  bool contains(const glm::dvec3& rest) const;
};

/** The scalars of an image of this name; its active ones, or its first, if there are none of it. */
VTKBRAINSHIFTFILTERS_EXPORT vtkDataArray* scalarsOf(vtkImageData* image, const std::string& name);

/** 1 where the labels are `label`, else 0: the scalars of a TissueRegion with level 0.5. */
VTKBRAINSHIFTFILTERS_EXPORT vtkSmartPointer<vtkDataArray> maskOfLabel(
  vtkDataArray* labels, int label);

/**
 * The triangles where the scalars pass the level. There are none on the grid's own faces and none
 * beside scalars that are not finite.
 */
VTKBRAINSHIFTFILTERS_EXPORT TriangleMesh surfaceOf(const TissueRegion& tissue);
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The surface of tissue in a volume at rest: where scalars pass a threshold, or where a label
/// ends.
#ifndef BrainShift_TissueSurface_h
#define BrainShift_TissueSurface_h

#include "Common/Grid.h"
#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include "vtkSmartPointer.h"

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

/** The tissue of an image, kept until something that it depends on changes. */
class TissueSource
{
public:
  /**
   * Finds it. Returns whether it is another one than before.
   *
   * @param isLabel   whether tissue is where scalars equal the level, or are not below it
   * @param level     a threshold or a label
   */
  bool find(vtkDataArray* scalars, const Grid& grid, bool isLabel, double level);

  const TissueRegion& region() const { return this->Region; }

  /** Modification time of the scalars that the tissue was found in. */
  unsigned long long time() const { return this->Time; }

private:
  TissueRegion Region;
  vtkSmartPointer<vtkDataArray> Scalars; // null: nothing was found yet
  unsigned long long Time = 0;           // of Scalars
  Grid ScalarsGrid;
  bool IsLabel = false;
  double Level = 0.0;
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

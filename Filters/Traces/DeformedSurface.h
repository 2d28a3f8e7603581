// SPDX-License-Identifier: BSD-3-Clause
// A surface that follows a lattice. What is found once: triangles and tree. After a stroke only
// points near a control point that changed are mapped again.
#ifndef BrainShift_DeformedSurface_h
#define BrainShift_DeformedSurface_h

#include "Filters/Deformation/Lattice.h"
#include "Filters/Traces/TissueSurface.h"
#include "Filters/Traces/TriangleTree.h"
#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include <glm/vec3.hpp>

#include <functional>
#include <vector>

namespace brainshift
{
class VTKBRAINSHIFTFILTERS_EXPORT DeformedSurface
{
public:
  DeformedSurface() = default;
  explicit DeformedSurface(TriangleMesh rest);

  bool isEmpty() const { return this->Rest.triangles.empty(); }
  const std::vector<glm::dvec3>& points() const { return this->Deformed; }

  // Moves the points to where the lattice puts them. Those of which `isRemoved` (of a deformed
  // position, mm) is true no longer count; it may be empty, and is asked for all points again.
  void follow(const Lattice& lattice, const std::function<bool(const glm::dvec3&)>& isRemoved);

  // Points that the last call of follow mapped.
  vtkIdType mapped() const { return this->Mapped; }

  // As TriangleTree::nearest, from a deformed position.
  TriangleTree::Nearest nearest(const glm::dvec3& deformed, int hint = -1) const
  {
    return this->Tree.nearest(deformed, hint);
  }

  // The same answer, sooner, where `before` was the nearest one until the last call of follow.
  TriangleTree::Nearest nearestAfterMove(const glm::dvec3& deformed, int before) const
  {
    return this->Tree.nearestAfterMove(deformed, before);
  }

  // A number for how things lie: the next one after each call of follow.
  int state() const { return this->Tree.fits(); }

private:
  void LayOn(const Grid& lattice);

  TriangleMesh Rest;
  std::vector<glm::dvec3> Deformed;
  TriangleTree Tree;
  Lattice Followed;        // what Deformed was made with
  std::vector<int> CellOf; // lattice cell of each point, of Followed's grid
  vtkIdType Mapped = 0;
  bool FitAll = true; // the next time
};
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A surface that follows a lattice.
///
/// Its triangles and their tree are found once. After a stroke only points near a control point
/// that changed are mapped again.
#ifndef BrainShift_DeformedSurface_h
#define BrainShift_DeformedSurface_h

#include "Filters/Deformation/Lattice.h"
#include "Filters/Traces/TriangleTree.h"

#include <functional>

namespace brainshift
{
/** Positions and distances are mm, world. */
class VTKBRAINSHIFTFILTERS_EXPORT DeformedSurface
{
public:
  DeformedSurface() = default;

  /** The surface at rest. */
  explicit DeformedSurface(TriangleMesh rest);

  bool isEmpty() const { return this->Rest.triangles.empty(); }

  /** The points where the last call of follow put them. */
  const std::vector<glm::dvec3>& points() const { return this->Deformed; }

  /**
   * Moves the points to where the lattice puts them.
   *
   * @param isRemoved   whether tissue at a deformed position was removed; points there do not
   *                    count. It may be empty. It is asked for all points at each call.
   */
  void follow(const Lattice& lattice, const std::function<bool(const glm::dvec3&)>& isRemoved);

  /** How many points the last call of follow mapped. */
  vtkIdType mapped() const { return this->Mapped; }

  /** The nearest point of the surface to a deformed position; see TriangleTree::nearest. */
  TriangleTree::Nearest nearest(const glm::dvec3& deformed, int hint = -1) const
  {
    return this->Tree.nearest(deformed, hint);
  }

  /**
   * Gives the answer of nearest() sooner if `before` was the nearest triangle until the last call
   * of follow.
   */
  TriangleTree::Nearest nearestAfterMove(const glm::dvec3& deformed, int before) const
  {
    return this->Tree.nearestAfterMove(deformed, before);
  }

  /** A number that grows by one with each call of follow. */
  int state() const { return this->Tree.fits(); }

private:
  void layOn(const Grid& lattice);

  TriangleMesh Rest;
  std::vector<glm::dvec3> Deformed;
  TriangleTree Tree;
  Lattice Followed;        // what Deformed was made with
  std::vector<int> CellOf; // lattice cell of each point, of Followed's grid
  vtkIdType Mapped = 0;
  bool FitAll = true; // at the next call of follow
};
}

#endif

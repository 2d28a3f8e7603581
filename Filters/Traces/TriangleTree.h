// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Finds the nearest point of a triangle mesh whose points move but whose triangles stay.
///
/// A tree of boxes is built once and fitted to the triangles again after each move: van den Bergen,
/// "Efficient collision detection of complex deformable models using AABB trees", Journal of
/// Graphics Tools 2 (1997). VTK's locators are built anew after each move.
#ifndef BrainShift_TriangleTree_h
#define BrainShift_TriangleTree_h

#include "Filters/Traces/TissueSurface.h"

namespace brainshift
{
/** Positions and distances are mm, world. */
class VTKBRAINSHIFTFILTERS_EXPORT TriangleTree
{
public:
  TriangleTree() = default;

  /** Builds the tree from where the points lie now. */
  explicit TriangleTree(const TriangleMesh& mesh);

  /**
   * Puts the points elsewhere.
   *
   * @param points   the mesh's points, in their order
   * @param moved    for each point whether it moved since the last call; empty: all moved. It must
   *                 be empty if `kept` is not
   * @param kept     for each point whether its triangles count; empty: all count
   */
  void fit(const std::vector<glm::dvec3>& points, const std::vector<char>& moved,
    const std::vector<char>& kept);

  /** An answer. */
  struct Nearest
  {
    double distance; ///< mm; infinite if there is no triangle
    int triangle;    ///< its number, which no move changes; below 0 if there is no triangle
  };

  /**
   * The nearest point of the triangles as they were last fitted. It is exact: triangles are flat.
   *
   * @param hint   any triangle, or below 0. A nearer one gives the same answer sooner.
   */
  Nearest nearest(const glm::dvec3& position, int hint = -1) const;

  /**
   * Gives the answer of nearest() sooner if `before` was the nearest triangle until the last fit:
   * if that triangle stayed, only triangles that moved can be nearer now.
   */
  Nearest nearestAfterMove(const glm::dvec3& position, int before) const;

  /** The numbers of the points of a triangle that nearest() found. */
  const glm::ivec3& corners(int triangle) const { return this->Triangles[triangle]; }

  /** How often the triangles were fitted. */
  int fits() const { return this->Fits; }

private:
  struct Box
  {
    glm::dvec3 low; // of the triangles below; low > high if there is none
    glm::dvec3 high;
  };
  // Kept apart from the boxes, because fitting reads all nodes but few boxes.
  struct Node
  {
    int first; // leaf: first triangle; else: the second child (the first one is the next node)
    int count; // leaf: triangles; else 0
  };
  struct Corners
  {
    glm::dvec3 a, b, c;
    bool kept;
  };

  bool fitLeaf(std::size_t node, const std::vector<glm::dvec3>& points,
    const std::vector<char>& moved, const std::vector<char>& kept);
  double squaredDistance(const glm::dvec3& position, int triangle) const;
  Nearest search(const glm::dvec3& position, int hint, bool amongMoved) const;
  int build(std::vector<glm::dvec3>& middles, std::vector<int>& order, int first, int end);

  std::vector<glm::ivec3> Triangles; // in the order of the leaves
  std::vector<Corners> Placed;       // the same ones, where they lie now
  std::vector<Node> Nodes;           // parents before their children
  std::vector<Box> Boxes;            // of the nodes
  std::vector<char> Fitted;          // nodes that the last fit reached
  std::vector<char> Moved;           // triangles that it did
  int Fits = 0;
};

/** The square of the distance (mm^2) from a position to the triangle between a, b and c. */
VTKBRAINSHIFTFILTERS_EXPORT double squaredDistanceToTriangle(
  const glm::dvec3& position, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);
}

#endif

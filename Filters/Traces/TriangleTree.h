// SPDX-License-Identifier: BSD-3-Clause
// Finds the nearest point of a triangle mesh whose points move but whose triangles stay: a tree of
// boxes, built once and fitted again after each move.
#ifndef BrainShift_TriangleTree_h
#define BrainShift_TriangleTree_h

#include "Filters/Traces/TissueSurface.h"
#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include <glm/vec3.hpp>

#include <vector>

namespace brainshift
{
class VTKBRAINSHIFTFILTERS_EXPORT TriangleTree
{
public:
  TriangleTree() = default;
  explicit TriangleTree(const TriangleMesh& mesh);

  // Puts the points, which are the mesh's in their order, elsewhere; only those that `moved` since
  // the last call, all if it is empty. Triangles with a point that is not `kept` are passed over;
  // an empty `kept` keeps all, and only then may `moved` name some.
  void fit(const std::vector<glm::dvec3>& points, const std::vector<char>& moved,
    const std::vector<char>& kept);

  struct Nearest
  {
    double distance; // mm; infinite if there is no triangle
    int triangle;    // a number that stays, whatever moves; below 0 if there is none
  };

  // The nearest point of the triangles as last fitted, exact for flat triangles. `hint`: any
  // triangle, or below 0; the nearer it is, the sooner the answer, which is the same.
  Nearest nearest(const glm::dvec3& position, int hint = -1) const;

  // The same answer where `before` was the nearest triangle until the last fit: if that one stayed,
  // only triangles that moved can be nearer now.
  Nearest nearestAfterMove(const glm::dvec3& position, int before) const;

  // How often the triangles were fitted.
  int fits() const { return this->Fits; }

private:
  struct Box
  {
    glm::dvec3 low; // of the triangles below; low > high if there is none
    glm::dvec3 high;
  };
  // Apart from the boxes: fitting looks at all of these and at few of those.
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

  bool FitLeaf(std::size_t node, const std::vector<glm::dvec3>& points,
    const std::vector<char>& moved, const std::vector<char>& kept);
  double SquaredDistance(const glm::dvec3& position, int triangle) const;
  Nearest Search(const glm::dvec3& position, int hint, bool amongMoved) const;
  int Build(std::vector<glm::dvec3>& middles, std::vector<int>& order, int first, int end);

  std::vector<glm::ivec3> Triangles; // in the order of the leaves
  std::vector<Corners> Placed;       // the same ones, where they lie now
  std::vector<Node> Nodes;           // parents before their children
  std::vector<Box> Boxes;            // of the nodes
  std::vector<char> Fitted;          // nodes that the last fit reached
  std::vector<char> Moved;           // triangles that it did
  int Fits = 0;
};

// Square of the distance from a position to a triangle.
VTKBRAINSHIFTFILTERS_EXPORT double squaredDistanceToTriangle(
  const glm::dvec3& position, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);
}

#endif

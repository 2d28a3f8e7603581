// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Traces/TriangleTree.h"

#include "Common/Parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace brainshift
{
namespace
{
constexpr int TrianglesPerLeaf = 4;
constexpr vtkIdType NodesAtLeast = 2048; // for a thread
constexpr double Infinity = std::numeric_limits<double>::infinity();

double squared(const glm::dvec3& vector)
{
  return glm::dot(vector, vector);
}

double squaredDistanceToBox(
  const glm::dvec3& position, const glm::dvec3& low, const glm::dvec3& high)
{
  return squared(glm::max(glm::max(low - position, position - high), glm::dvec3(0.0)));
}

// From the origin to the edge from `start`, `along` mm and way to its end.
double squaredDistanceToEdge(const glm::dvec3& start, const glm::dvec3& along)
{
  const double length = squared(along);
  const double share = length > 0.0 ? glm::clamp(-glm::dot(start, along) / length, 0.0, 1.0) : 0.0;
  return squared(start + share * along);
}
}

double squaredDistanceToTriangle(
  const glm::dvec3& position, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
{
  const glm::dvec3 toA = a - position;
  const glm::dvec3 ab = b - a;
  const glm::dvec3 ac = c - a;
  const double abab = squared(ab);
  const double abac = glm::dot(ab, ac);
  const double acac = squared(ac);
  const double alongAb = -glm::dot(ab, toA);
  const double alongAc = -glm::dot(ac, toA);
  // The foot of the position in the triangle's plane is a + (s ab + t ac) / area.
  const double area = abab * acac - abac * abac;
  const double s = acac * alongAb - abac * alongAc;
  const double t = abab * alongAc - abac * alongAb;
  const bool flat = !(area > 0.0);
  if (!flat && s >= 0.0 && t >= 0.0 && s + t <= area)
  {
    return squared(toA + (s * ab + t * ac) / area);
  }
  // The nearest point lies on an edge that the foot is beyond.
  double nearest = Infinity;
  if (flat || s < 0.0)
  {
    nearest = squaredDistanceToEdge(toA, ac);
  }
  if (flat || t < 0.0)
  {
    nearest = std::min(nearest, squaredDistanceToEdge(toA, ab));
  }
  if (flat || s + t > area)
  {
    nearest = std::min(nearest, squaredDistanceToEdge(toA + ab, ac - ab));
  }
  return nearest;
}

TriangleTree::TriangleTree(const TriangleMesh& mesh)
{
  const std::size_t count = mesh.triangles.size();
  std::vector<glm::dvec3> middles(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    const glm::ivec3& corners = mesh.triangles[i];
    middles[i] = (mesh.points[corners.x] + mesh.points[corners.y] + mesh.points[corners.z]) / 3.0;
  }
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  if (count > 0)
  {
    this->Nodes.reserve(2 * count / TrianglesPerLeaf + 1);
    this->build(middles, order, 0, static_cast<int>(count));
  }
  this->Triangles.resize(count);
  std::transform(order.begin(), order.end(), this->Triangles.begin(),
    [&](int triangle) { return mesh.triangles[triangle]; });
  this->Placed.resize(count);
  this->Boxes.resize(this->Nodes.size());
  this->fit(mesh.points, {}, {});
}

int TriangleTree::build(
  std::vector<glm::dvec3>& middles, std::vector<int>& order, int first, int end)
{
  const int node = static_cast<int>(this->Nodes.size());
  this->Nodes.push_back({ first, end - first });
  if (end - first <= TrianglesPerLeaf)
  {
    return node;
  }
  glm::dvec3 low(Infinity);
  glm::dvec3 high(-Infinity);
  for (int i = first; i < end; ++i)
  {
    low = glm::min(low, middles[order[i]]);
    high = glm::max(high, middles[order[i]]);
  }
  const glm::dvec3 size = high - low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const int half = first + (end - first) / 2;
  std::nth_element(order.begin() + first, order.begin() + half, order.begin() + end,
    [&](int left, int right) { return middles[left][axis] < middles[right][axis]; });
  this->build(middles, order, first, half);
  const int second = this->build(middles, order, half, end);
  this->Nodes[node].first = second;
  this->Nodes[node].count = 0;
  return node;
}

// Whether the leaf had to be fitted.
bool TriangleTree::fitLeaf(std::size_t node, const std::vector<glm::dvec3>& points,
  const std::vector<char>& moved, const std::vector<char>& kept)
{
  const Node& leaf = this->Nodes[node];
  const auto any = [&](const std::vector<char>& flags) {
    return std::any_of(this->Triangles.begin() + leaf.first,
      this->Triangles.begin() + leaf.first + leaf.count,
      [&](const glm::ivec3& id) { return flags[id.x] || flags[id.y] || flags[id.z]; });
  };
  if (!moved.empty() && !any(moved))
  {
    return false;
  }
  Box box{ glm::dvec3(Infinity), glm::dvec3(-Infinity) };
  for (int i = leaf.first; i < leaf.first + leaf.count; ++i)
  {
    const glm::ivec3& id = this->Triangles[i];
    Corners& placed = this->Placed[i];
    placed = { points[id.x], points[id.y], points[id.z],
      kept.empty() || (kept[id.x] && kept[id.y] && kept[id.z]) };
    if (placed.kept)
    {
      box.low = glm::min(glm::min(box.low, placed.a), glm::min(placed.b, placed.c));
      box.high = glm::max(glm::max(box.high, placed.a), glm::max(placed.b, placed.c));
    }
  }
  this->Boxes[node] = box;
  return true;
}

void TriangleTree::fit(const std::vector<glm::dvec3>& points, const std::vector<char>& moved,
  const std::vector<char>& kept)
{
  ++this->Fits;
  const auto count = static_cast<vtkIdType>(this->Nodes.size());
  this->Fitted.assign(this->Nodes.size(), 0);
  this->Moved.assign(this->Triangles.size(), 0);
  parallelFor(0, count, NodesAtLeast, [&](vtkIdType first, vtkIdType end) {
    for (vtkIdType i = first; i < end; ++i)
    {
      const Node& node = this->Nodes[i];
      if (node.count > 0 && this->fitLeaf(i, points, moved, kept))
      {
        this->Fitted[i] = 1;
        std::fill_n(this->Moved.begin() + node.first, node.count, char(1));
      }
    }
  });
  for (vtkIdType node = count - 1; node >= 0; --node)
  {
    const vtkIdType second = this->Nodes[node].first;
    if (this->Nodes[node].count == 0 && (this->Fitted[node + 1] || this->Fitted[second]))
    {
      const Box& left = this->Boxes[node + 1];
      const Box& right = this->Boxes[second];
      this->Boxes[node] = { glm::min(left.low, right.low), glm::max(left.high, right.high) };
      this->Fitted[node] = 1;
    }
  }
}

double TriangleTree::squaredDistance(const glm::dvec3& position, int triangle) const
{
  const Corners& corners = this->Placed[triangle];
  return corners.kept ? squaredDistanceToTriangle(position, corners.a, corners.b, corners.c)
                      : Infinity;
}

TriangleTree::Nearest TriangleTree::nearest(const glm::dvec3& position, int hint) const
{
  constexpr bool amongMoved = false;
  return this->search(position, hint, amongMoved);
}

TriangleTree::Nearest TriangleTree::nearestAfterMove(const glm::dvec3& position, int before) const
{
  return this->search(position, before, before >= 0 && !this->Moved[before]);
}

// The nearest of all triangles, or of the hint and those that moved.
TriangleTree::Nearest TriangleTree::search(
  const glm::dvec3& position, int hint, bool amongMoved) const
{
  struct Visit
  {
    int node;
    double nearest; // squared distance to its box
  };
  Visit open[64]; // as deep as the tree: it halves, so 2^62 triangles
  int openCount = 0;
  double best = hint < 0 ? Infinity : this->squaredDistance(position, hint);
  int triangle = best < Infinity ? hint : -1;
  const auto visit = [&](int node) {
    const Box& box = this->Boxes[node];
    return Visit{ node, squaredDistanceToBox(position, box.low, box.high) };
  };
  const auto add = [&](const Visit& found) {
    if (found.nearest < best && (!amongMoved || this->Fitted[found.node]))
    {
      open[openCount++] = found;
    }
  };
  if (!this->Nodes.empty())
  {
    add(visit(0));
  }
  while (openCount > 0)
  {
    const Visit next = open[--openCount];
    if (!(next.nearest < best))
    {
      continue;
    }
    const Node& node = this->Nodes[next.node];
    for (int i = node.first; i < node.first + node.count; ++i)
    {
      const double distance = this->squaredDistance(position, i);
      triangle = distance < best ? i : triangle;
      best = std::min(best, distance);
    }
    if (node.count == 0)
    {
      Visit near = visit(next.node + 1);
      Visit far = visit(node.first);
      if (far.nearest < near.nearest)
      {
        std::swap(near, far);
      }
      add(far);
      add(near);
    }
  }
  return { std::sqrt(best), triangle };
}
}

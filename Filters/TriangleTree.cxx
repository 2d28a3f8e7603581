// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleTree.h"

#include "Parallel.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

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

double squaredDistanceToEdge(const glm::dvec3& position, const glm::dvec3& a, const glm::dvec3& b)
{
  const glm::dvec3 edge = b - a;
  const double length = squared(edge);
  const double along =
    length > 0.0 ? glm::clamp(glm::dot(position - a, edge) / length, 0.0, 1.0) : 0.0;
  return squared(position - (a + along * edge));
}
}

double squaredDistanceToTriangle(
  const glm::dvec3& position, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
{
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const auto isInside = [&](const glm::dvec3& from, const glm::dvec3& to) {
    return glm::dot(glm::cross(to - from, position - from), normal) >= 0.0;
  };
  if (squared(normal) > 0.0 && isInside(a, b) && isInside(b, c) && isInside(c, a))
  {
    const double height = glm::dot(position - a, normal);
    return height * height / squared(normal);
  }
  return std::min({ squaredDistanceToEdge(position, a, b), squaredDistanceToEdge(position, b, c),
    squaredDistanceToEdge(position, c, a) });
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
    this->Build(middles, order, 0, static_cast<int>(count));
  }
  this->Triangles.resize(count);
  std::transform(order.begin(), order.end(), this->Triangles.begin(),
    [&](int triangle) { return mesh.triangles[triangle]; });
  this->Placed.resize(count);
  this->Boxes.resize(this->Nodes.size());
  this->fit(mesh.points, {}, {});
}

int TriangleTree::Build(
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
  this->Build(middles, order, first, half);
  const int second = this->Build(middles, order, half, end);
  this->Nodes[node].first = second;
  this->Nodes[node].count = 0;
  return node;
}

// Whether the leaf had to be fitted.
bool TriangleTree::FitLeaf(std::size_t node, const std::vector<glm::dvec3>& points,
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
  std::vector<char> fitted(this->Nodes.size(), 0);
  const auto count = static_cast<vtkIdType>(this->Nodes.size());
  parallelFor(0, count, NodesAtLeast, [&](vtkIdType first, vtkIdType end) {
    for (vtkIdType node = first; node < end; ++node)
    {
      fitted[node] = this->Nodes[node].count > 0 && this->FitLeaf(node, points, moved, kept);
    }
  });
  for (vtkIdType node = count - 1; node >= 0; --node)
  {
    const vtkIdType second = this->Nodes[node].first;
    if (this->Nodes[node].count == 0 && (fitted[node + 1] || fitted[second]))
    {
      const Box& left = this->Boxes[node + 1];
      const Box& right = this->Boxes[second];
      this->Boxes[node] = { glm::min(left.low, right.low), glm::max(left.high, right.high) };
      fitted[node] = 1;
    }
  }
}

double TriangleTree::distance(const glm::dvec3& position, double limit) const
{
  struct Visit
  {
    int node;
    double nearest; // squared distance to its box
  };
  Visit open[64]; // as deep as the tree: it halves, so 2^62 triangles
  int openCount = 0;
  double best = limit * limit;
  const auto visit = [&](int node) {
    const Box& box = this->Boxes[node];
    return Visit{ node, squaredDistanceToBox(position, box.low, box.high) };
  };
  if (!this->Nodes.empty())
  {
    open[openCount++] = visit(0);
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
      const Corners& corners = this->Placed[i];
      if (corners.kept)
      {
        best = std::min(best, squaredDistanceToTriangle(position, corners.a, corners.b, corners.c));
      }
    }
    if (node.count == 0)
    {
      Visit near = visit(next.node + 1);
      Visit far = visit(node.first);
      if (far.nearest < near.nearest)
      {
        std::swap(near, far);
      }
      open[openCount++] = far;
      open[openCount++] = near;
    }
  }
  return std::sqrt(best);
}
}

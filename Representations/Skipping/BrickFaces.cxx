// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Skipping/BrickFaces.h"

#include <algorithm>

namespace brainshift
{
namespace
{
// The axes of a plane: one across it, and two in it. Neighbours along the first are nearer in
// memory.
struct PlaneAxes
{
  int across;
  int along;
  int up;
};

constexpr PlaneAxes Planes[3] = { { 0, 1, 2 }, { 1, 0, 2 }, { 2, 0, 1 } };

// Faces side by side in a row that look in one direction, and the row in which the rectangle that
// they belong to starts.
struct Run
{
  int outward;
  int from;
  int to; // one past the last
  int firstRow;
};

class PlaneMerger
{
public:
  PlaneMerger(const std::vector<std::uint8_t>& occupied, const glm::ivec3& count,
    const PlaneAxes& axes, std::vector<BrickRectangle>& downward,
    std::vector<BrickRectangle>& upward)
    : Occupied(occupied)
    , Count(count)
    , Axes(axes)
    , Stride{ 1, count.x, static_cast<std::ptrdiff_t>(count.x) * count.y }
    , Downward(downward)
    , Upward(upward)
  {
  }

  // The faces between the bricks `plane` - 1 and `plane`.
  void merge(int plane)
  {
    this->Plane = plane;
    this->Below.clear();
    for (int row = 0; row < this->Count[this->Axes.up]; ++row)
    {
      this->findRuns(row);
      this->join(row);
      std::swap(this->Below, this->Runs);
    }
    this->Runs.clear();
    this->join(this->Count[this->Axes.up]);
  }

private:
  void findRuns(int row)
  {
    const std::ptrdiff_t step = this->Stride[this->Axes.along];
    const std::ptrdiff_t across = this->Stride[this->Axes.across];
    const std::uint8_t* after =
      this->Occupied.data() + this->Plane * across + row * this->Stride[this->Axes.up];
    const bool first = this->Plane == 0;
    const bool last = this->Plane == this->Count[this->Axes.across];
    const int length = this->Count[this->Axes.along];
    this->Runs.clear();
    int outward = 0; // of the present run, if any
    for (int i = 0; i < length; ++i, after += step)
    {
      const int here = !last && after[0] != 0;
      const int before = !first && after[-across] != 0;
      if (before - here == outward)
      {
        continue;
      }
      if (outward != 0)
      {
        this->Runs.back().to = i;
      }
      outward = before - here;
      if (outward != 0)
      {
        this->Runs.push_back({ outward, i, length, row });
      }
    }
  }

  // A run that is as long as the run below continues its rectangle. Other runs below are finished.
  void join(int row)
  {
    auto run = this->Runs.begin();
    for (const Run& below : this->Below)
    {
      run =
        std::find_if(run, this->Runs.end(), [&](const Run& one) { return one.from >= below.from; });
      if (run != this->Runs.end() && run->from == below.from && run->to == below.to &&
        run->outward == below.outward)
      {
        run->firstRow = below.firstRow;
      }
      else
      {
        this->append(below, row);
      }
    }
  }

  void append(const Run& run, int endRow)
  {
    BrickRectangle rectangle;
    rectangle.axis = this->Axes.across;
    rectangle.low[this->Axes.across] = rectangle.high[this->Axes.across] = this->Plane;
    rectangle.low[this->Axes.along] = run.from;
    rectangle.high[this->Axes.along] = run.to;
    rectangle.low[this->Axes.up] = run.firstRow;
    rectangle.high[this->Axes.up] = endRow;
    (run.outward > 0 ? this->Upward : this->Downward).push_back(rectangle);
  }

  const std::vector<std::uint8_t>& Occupied;
  glm::ivec3 Count;
  PlaneAxes Axes;
  std::ptrdiff_t Stride[3];
  std::vector<BrickRectangle>& Downward;
  std::vector<BrickRectangle>& Upward;
  int Plane = 0;
  std::vector<Run> Below; // runs of the row below, in order
  std::vector<Run> Runs;  // of the present row
};
}

std::array<BrickFaces, 6> brickFaces(
  const std::vector<std::uint8_t>& occupied, const glm::ivec3& count)
{
  std::array<BrickFaces, 6> faces;
  for (int axis = 0; axis < 3; ++axis)
  {
    BrickFaces& downward = faces[2 * axis];
    BrickFaces& upward = faces[2 * axis + 1];
    downward.axis = upward.axis = axis;
    downward.outward = -1;
    PlaneMerger merger(occupied, count, Planes[axis], downward.rectangles, upward.rectangles);
    for (int plane = 0; plane <= count[axis]; ++plane)
    {
      merger.merge(plane);
    }
  }
  return faces;
}

std::vector<IndexBox> occupiedLayers(const std::array<BrickFaces, 6>& faces, int layers)
{
  std::vector<IndexBox> boxes(layers);
  // A row of occupied bricks ends at a face across x on either side.
  for (const BrickFaces* across : { &faces[0], &faces[1] })
  {
    for (const BrickRectangle& rectangle : across->rectangles)
    {
      const int x = across->outward > 0 ? rectangle.low.x - 1 : rectangle.low.x;
      for (int z = rectangle.low.z; z < rectangle.high.z; ++z)
      {
        boxes[z] =
          enclosing(boxes[z], { { x, rectangle.low.y, z }, { x, rectangle.high.y - 1, z } });
      }
    }
  }
  boxes.erase(
    std::remove_if(boxes.begin(), boxes.end(), [](const IndexBox& box) { return box.empty(); }),
    boxes.end());
  return boxes;
}

std::pair<int, int> facing(const BrickFaces& faces, const glm::dvec4& eye)
{
  const int all = static_cast<int>(faces.rectangles.size());
  if (eye.w == 0.0)
  {
    return { 0, eye[faces.axis] * faces.outward > 0.0 ? all : 0 };
  }
  const double place = eye[faces.axis] / eye.w;
  const auto beyond = std::partition_point(faces.rectangles.begin(), faces.rectangles.end(),
    [&](const BrickRectangle& rectangle) { return rectangle.low[faces.axis] < place; });
  const int below = static_cast<int>(beyond - faces.rectangles.begin());
  return faces.outward > 0 ? std::make_pair(0, below) : std::make_pair(below, all);
}
}

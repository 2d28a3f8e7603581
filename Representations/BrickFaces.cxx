// SPDX-License-Identifier: BSD-3-Clause
#include "BrickFaces.h"

#include <algorithm>
#include <cstddef>

namespace brainshift
{
namespace
{
// The axes of a plane: one across it, and two in it, the first of which is nearer in memory.
struct PlaneAxes
{
  int across;
  int along;
  int up;
};

constexpr PlaneAxes Planes[3] = { { 0, 1, 2 }, { 1, 0, 2 }, { 2, 0, 1 } };

// Faces side by side in a row, and the row where the first such run below them starts.
struct Run
{
  int from;
  int to; // one past the last
  int firstRow;
};

class PlaneMerger
{
public:
  PlaneMerger(const std::vector<std::uint8_t>& occupied, const glm::ivec3& count,
    const PlaneAxes& axes, std::vector<BrickRectangle>& out)
    : Occupied(occupied)
    , Count(count)
    , Axes(axes)
    , Stride{ 1, count.x, static_cast<std::ptrdiff_t>(count.x) * count.y }
    , Out(out)
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
    bool inRun = false;
    for (int i = 0; i < length; ++i, after += step)
    {
      const bool here = !last && after[0] != 0;
      const bool before = !first && after[-across] != 0;
      if ((here != before) == inRun)
      {
        continue;
      }
      if (inRun)
      {
        this->Runs.back().to = i;
      }
      else
      {
        this->Runs.push_back({ i, length, row });
      }
      inRun = !inRun;
    }
  }

  // Runs as long as the one below go on with it; runs below that nothing goes on with are done.
  void join(int row)
  {
    auto run = this->Runs.begin();
    for (const Run& below : this->Below)
    {
      run =
        std::find_if(run, this->Runs.end(), [&](const Run& one) { return one.from >= below.from; });
      if (run != this->Runs.end() && run->from == below.from && run->to == below.to)
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
    this->Out.push_back(rectangle);
  }

  const std::vector<std::uint8_t>& Occupied;
  glm::ivec3 Count;
  PlaneAxes Axes;
  std::ptrdiff_t Stride[3];
  std::vector<BrickRectangle>& Out;
  int Plane = 0;
  std::vector<Run> Below; // runs of the row below, in order
  std::vector<Run> Runs;  // of the present row
};
}

std::vector<BrickRectangle> brickRectangles(
  const std::vector<std::uint8_t>& occupied, const glm::ivec3& count)
{
  std::vector<BrickRectangle> rectangles;
  for (const PlaneAxes& axes : Planes)
  {
    PlaneMerger merger(occupied, count, axes, rectangles);
    for (int plane = 0; plane <= count[axes.across]; ++plane)
    {
      merger.merge(plane);
    }
  }
  return rectangles;
}
}

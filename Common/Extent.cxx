// SPDX-License-Identifier: BSD-3-Clause
#include "Common/Extent.h"

#include <algorithm>

namespace brainshift
{
bool isEmpty(const Extent& extent)
{
  return extent[1] < extent[0] || extent[3] < extent[2] || extent[5] < extent[4];
}

Extent common(const Extent& a, const Extent& b)
{
  Extent both{};
  for (int axis = 0; axis < 3; ++axis)
  {
    both[2 * axis] = std::max(a[2 * axis], b[2 * axis]);
    both[2 * axis + 1] = std::min(a[2 * axis + 1], b[2 * axis + 1]);
  }
  return both;
}

bool holds(const Extent& extent, const Extent& other)
{
  bool all = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    all = all && extent[2 * axis] <= other[2 * axis] && extent[2 * axis + 1] >= other[2 * axis + 1];
  }
  return all;
}

Extent around(const Extent& a, const Extent& b)
{
  Extent both = a;
  for (int axis = 0; axis < 3; ++axis)
  {
    both[2 * axis] = std::min(a[2 * axis], b[2 * axis]);
    both[2 * axis + 1] = std::max(a[2 * axis + 1], b[2 * axis + 1]);
  }
  return both;
}

double pointsIn(const Extent& extent)
{
  double points = 1.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    points *= std::max(0.0, extent[2 * axis + 1] - extent[2 * axis] + 1.0);
  }
  return points;
}
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Register/LineSearch.h"

#include <cmath>
#include <utility>

namespace brainshift
{
namespace
{
constexpr double Golden = 0.381966;
constexpr double Growth = 1.618034;
constexpr int MostSteps = 20; // of each of the two parts

// Where the parabola through three points is lowest; the middle point if it has no lowest place.
double lowestOfParabola(const LinePoint& a, const LinePoint& b, const LinePoint& c)
{
  const double p = (b.at - a.at) * (b.value - c.value);
  const double q = (b.at - c.at) * (b.value - a.value);
  const double below = 2.0 * (p - q);
  return below != 0.0 ? b.at - ((b.at - a.at) * p - (b.at - c.at) * q) / below : b.at;
}
}

LinePoint lowestAlong(const std::function<double(double)>& function, double valueAtZero,
  double stride, double tolerance)
{
  const auto pointAt = [&](double at) { return LinePoint{ at, function(at) }; };
  LinePoint left{ 0.0, valueAtZero };
  LinePoint middle = pointAt(stride);
  if (middle.value > left.value)
  {
    std::swap(left, middle);
  }
  LinePoint right = pointAt(middle.at + (middle.at > left.at ? stride : -stride));
  for (int step = 0; step < MostSteps && right.value < middle.value; ++step)
  {
    left = middle;
    middle = right;
    right = pointAt(middle.at + Growth * (middle.at - left.at));
  }
  // `middle` is below both others.
  for (int step = 0; step < MostSteps && std::abs(right.at - left.at) > 2.0 * tolerance; ++step)
  {
    const LinePoint& wider =
      std::abs(right.at - middle.at) > std::abs(left.at - middle.at) ? right : left;
    double at = lowestOfParabola(left, middle, right);
    const bool isNew = std::abs(at - middle.at) > 0.5 * tolerance &&
      (at - left.at) * (at - right.at) < 0.0 && step % 3 != 2;
    if (!isNew)
    {
      const double least = 0.5 * tolerance;
      const double part = Golden * (wider.at - middle.at);
      at = middle.at + (std::abs(part) < least ? std::copysign(least, part) : part);
    }
    const LinePoint found = pointAt(at);
    const bool isLower = found.value < middle.value;
    const LinePoint outer = isLower ? middle : found;
    const LinePoint inner = isLower ? found : middle;
    // The outer one takes the place of the end on its side.
    ((outer.at - inner.at) * (right.at - left.at) > 0.0 ? right : left) = outer;
    middle = inner;
    if (isLower && std::abs(outer.at - inner.at) < 0.5 * tolerance)
    {
      break;
    }
  }
  return middle.value < valueAtZero ? middle : LinePoint{ 0.0, valueAtZero };
}
}

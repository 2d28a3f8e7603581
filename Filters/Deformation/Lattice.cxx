// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Deformation/Lattice.h"

#include "Common/Parallel.h"
#include "Common/Problem.h"
#include "Filters/Deformation/Inversion.h"
#include "Filters/Deformation/Kernels.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace brainshift
{
namespace
{
constexpr std::int64_t PointsAtLeast = 32768; // for a thread: about 0.2 ms

// A Soft stroke lengthens its vector at most by 1 / this. A radius that holds few control points
// would otherwise throw them far.
constexpr double SmallestSoftFraction = 0.2;

// Turns values along one line of control points into coefficients of a B-spline that has these
// values at them. Beyond the ends the value of the end holds, as in the cubic.
void coefficientsAlong(std::vector<glm::dvec3>& line)
{
  // (c[i-1] + 4 c[i] + c[i+1]) / 6 = value: eliminated from the first to the last, then back.
  const std::size_t count = line.size();
  std::vector<double> above(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    const double own = (i == 0 || i + 1 == count) ? 5.0 : 4.0;
    const double pivot = own - (i == 0 ? 0.0 : above[i - 1]);
    above[i] = 1.0 / pivot;
    line[i] = (6.0 * line[i] - (i == 0 ? glm::dvec3(0.0) : line[i - 1])) / pivot;
  }
  for (std::size_t i = count - 1; i-- > 0;)
  {
    line[i] -= above[i] * line[i + 1];
  }
}

// The four control points around a position along one axis and their weights.
struct Taps
{
  int index[4];
  glm::vec4 weight;
  glm::vec4 slope;
};

Taps tapsAt(int kernel, int points, double position)
{
  const double inside = std::clamp(position, 0.0, points - 1.0);
  const int cell = std::min(static_cast<int>(inside), points - 2);
  const float t = static_cast<float>(inside - cell);
  Taps taps;
  for (int tap = 0; tap < 4; ++tap)
  {
    taps.index[tap] = std::clamp(cell - 1 + tap, 0, points - 1);
  }
  taps.weight = kernelWeights(kernel, t);
  taps.slope = position == inside ? kernelSlopes(kernel, t) : glm::vec4(0.0f);
  return taps;
}

// Those along each axis.
using TapsOfAxes = std::array<Taps, 3>;

TapsOfAxes tapsAround(const glm::ivec3& dimensions, int kernel, const glm::dvec3& position)
{
  return { tapsAt(kernel, dimensions.x, position.x), tapsAt(kernel, dimensions.y, position.y),
    tapsAt(kernel, dimensions.z, position.z) };
}

// The four control points of one row around a position.
struct RowOfTaps
{
  const glm::vec3* tap[4];

  RowOfTaps(
    const glm::ivec3& dimensions, const glm::vec3* values, const TapsOfAxes& taps, int j, int k)
  {
    const glm::vec3* row = values +
      (static_cast<std::size_t>(taps[2].index[k]) * dimensions.y + taps[1].index[j]) * dimensions.x;
    for (int i = 0; i < 4; ++i)
    {
      this->tap[i] = row + taps[0].index[i];
    }
  }

  glm::vec3 sum(const glm::vec4& weight) const
  {
    return weight[0] * *this->tap[0] + weight[1] * *this->tap[1] + weight[2] * *this->tap[2] +
      weight[3] * *this->tap[3];
  }
};

// Four numbers that the processor adds in one step. Compilers do not find these steps by themselves
// in the sums of cubicValue.
using Four [[gnu::vector_size(16)]] = float;

Four fourOf(const glm::vec4& vector)
{
  return Four{ vector.x, vector.y, vector.z, vector.w };
}

// Taps with their four weights side by side.
struct FourTaps
{
  int index[4];
  Four weight;
  Four slope;
};

FourTaps fourTapsAt(const glm::mat4& polynomials, int points, double position)
{
  const double inside = std::clamp(position, 0.0, points - 1.0);
  const int cell = std::min(static_cast<int>(inside), points - 2);
  const auto t = static_cast<float>(inside - cell);
  const Four one = fourOf(polynomials[1]);
  const Four two = fourOf(polynomials[2]);
  const Four three = fourOf(polynomials[3]);
  FourTaps taps;
  for (int tap = 0; tap < 4; ++tap)
  {
    taps.index[tap] = std::clamp(cell - 1 + tap, 0, points - 1);
  }
  taps.weight = fourOf(polynomials[0]) + t * (one + t * (two + t * three));
  taps.slope = position == inside ? one + t * (2.0f * two + t * (3.0f * three)) : Four{};
  return taps;
}

glm::vec3 threeOf(const Four& four)
{
  return { four[0], four[1], four[2] };
}

// The forward map around one position, in lattice coordinates. With a mask it evaluates the eight
// nodes around a point and no others.
struct ForwardAround
{
  const Lattice& lattice;
  glm::dvec3 reference;

  // Of tissue at `rest` from the reference. `jacobian`: of position + displacement.
  void map(const glm::vec3& rest, glm::vec3& displacement, glm::mat3& jacobian) const
  {
    const glm::dvec3 position = this->reference + glm::dvec3(rest);
    glm::mat3 gradient(0.0f); // mm for each cell
    const glm::vec3 moved =
      this->lattice.mask ? this->masked(position, gradient) : this->unmasked(position, gradient);
    displacement = this->inCells(moved);
    for (int axis = 0; axis < 3; ++axis)
    {
      jacobian[axis] = this->inCells(gradient[axis]);
      jacobian[axis][axis] += 1.0f;
    }
  }

private:
  glm::vec3 inCells(const glm::vec3& mm) const
  {
    return glm::vec3(this->lattice.grid.gridVectorFromWorld(glm::dvec3(mm)));
  }

  glm::vec3 at(const glm::dvec3& position) const
  {
    return cubicDisplacement(this->lattice.grid.dimensions, this->lattice.kernel,
      this->lattice.displacements.data(), position);
  }

  glm::vec3 unmasked(const glm::dvec3& position, glm::mat3& gradient) const
  {
    gradient = cubicGradient(this->lattice.grid.dimensions, this->lattice.kernel,
      this->lattice.displacements.data(), position);
    return this->at(position);
  }

  glm::vec3 masked(const glm::dvec3& position, glm::mat3& gradient) const
  {
    const NodeWeights& mask = *this->lattice.mask;
    const double perCell = mask.perCell;
    const glm::ivec3 count = (this->lattice.grid.dimensions - 1) * mask.perCell + 1;
    const glm::dvec3 node = glm::clamp(position * perCell, glm::dvec3(0.0), glm::dvec3(count - 1));
    const glm::ivec3 low = glm::min(glm::ivec3(node), count - 2);
    const glm::dvec3 within = node - glm::dvec3(low);
    glm::vec3 sum(0.0f);
    for (int corner = 0; corner < 8; ++corner)
    {
      const glm::ivec3 side(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
      const glm::ivec3 at = low + side;
      const float share =
        mask.values[(static_cast<std::size_t>(at.z) * count.y + at.y) * count.x + at.x];
      const glm::vec3 value = share * this->at(glm::dvec3(at) / perCell);
      const glm::vec3 part(glm::mix(1.0 - within, within, glm::dvec3(side)));
      const glm::vec3 slope = (2.0f * glm::vec3(side) - 1.0f) * static_cast<float>(perCell);
      sum += part.x * part.y * part.z * value;
      gradient[0] += slope.x * part.y * part.z * value;
      gradient[1] += part.x * slope.y * part.z * value;
      gradient[2] += part.x * part.y * slope.z * value;
    }
    return sum;
  }
};

// The control point of a lattice `ratio` times as dense, `distance` points of the coarser one away
// from a point of that, whose basis function the denser lattice is to repeat. With Catmull-Rom it
// is the function's value there. B-splines do not pass through their control points; this is the
// coefficient that makes the denser ones add up to a cubic, and to the coarser B-spline exactly
// where every knot of it is one of theirs.
double basisFunction(int kernel, double distance, double ratio)
{
  const double away = std::abs(distance);
  if (away >= 2.0)
  {
    return 0.0;
  }
  const int cell = static_cast<int>(away);
  // At t in the cell right of the point, the point is the second of the four taps; one cell
  // further it is the first.
  const double value = kernelWeights(kernel, static_cast<float>(away - cell))[1 - cell];
  const double curvature = cell == 0 ? 3.0 * away - 2.0 : 2.0 - away; // of a B-spline
  return kernel == KernelBSpline ? value - curvature / (6.0 * ratio * ratio) : value;
}

// The lattice that a Move was made at, on a denser one or the same.
struct MadeAt
{
  glm::dvec3 ratio; // of its spacing to that of the denser lattice
  glm::dvec3 last;  // control point, in its own coordinates
  glm::dvec3 point; // the one that the stroke moves

  MadeAt(const Grid& grid, const Stroke& stroke)
  {
    glm::dvec3 spacing = stroke.axis;
    if (glm::any(glm::lessThanEqual(spacing, glm::dvec3(0.0))))
    {
      spacing = stroke.major > 0.0 ? glm::dvec3(stroke.major) : grid.spacing;
    }
    this->ratio = glm::max(spacing / grid.spacing, glm::dvec3(1.0));
    this->last = glm::dvec3(grid.dimensions - 1) / this->ratio;
    this->point = glm::clamp(
      glm::round(grid.gridFromWorld(stroke.anchor) / this->ratio), glm::dvec3(0.0), this->last);
  }
};

void applyMove(Lattice& lattice, const Stroke& stroke)
{
  const Grid& grid = lattice.grid;
  const MadeAt madeAt(grid, stroke);
  const glm::dvec3& ratio = madeAt.ratio;
  const glm::dvec3& last = madeAt.last;
  const glm::dvec3& point = madeAt.point;
  const glm::dvec3 end(grid.dimensions - 1);
  // Clamped first: a far position is no integer.
  const glm::ivec3 low(glm::clamp(glm::ceil((point - 2.0) * ratio), glm::dvec3(0.0), end));
  const glm::ivec3 high(glm::clamp(glm::floor((point + 2.0) * ratio), glm::dvec3(0.0), end));
  const auto weightAlong = [&](int axis, int index) {
    const double distance = index / ratio[axis] - point[axis];
    // On the lattice it was made at the stroke moves one control point, whatever the kernel.
    if (ratio[axis] == 1.0)
    {
      return double(std::abs(distance) < 0.5);
    }
    // A point at the border stands for its missing neighbour too.
    const double below = point[axis] < 0.5 ? distance + 1.0 : 2.0;
    const double above = point[axis] > last[axis] - 0.5 ? distance - 1.0 : 2.0;
    return basisFunction(lattice.kernel, distance, ratio[axis]) +
      basisFunction(lattice.kernel, below, ratio[axis]) +
      basisFunction(lattice.kernel, above, ratio[axis]);
  };
  forEachIndex(low, high, [&](const glm::ivec3& at) {
    const double weight = weightAlong(0, at.x) * weightAlong(1, at.y) * weightAlong(2, at.z);
    lattice.displacements[grid.offset(at.x, at.y, at.z)] += glm::vec3(weight * stroke.vector);
  });
}

// Soft and Stamp: the weight of a control point where it is now.
double weightOf(const Lattice& lattice, const Stroke& stroke, const glm::ivec3& at)
{
  const Grid& grid = lattice.grid;
  const glm::dvec3 deformed = grid.worldFromGrid(glm::dvec3(at)) +
    glm::dvec3(lattice.displacements[grid.offset(at.x, at.y, at.z)]);
  const glm::dvec3 fromAnchor = deformed - stroke.anchor;
  const double reach = std::max(stroke.major, stroke.minor);
  return glm::dot(fromAnchor, fromAnchor) < reach * reach
    ? falloff(normalisedDistance(stroke, deformed), stroke.sigma)
    : 0.0;
}

// The share of a stroke's vector by which the tissue at its anchor moves if each control point
// moves by its weight. It is below 1 because the kernel averages weights that fall off.
double shareAtAnchor(const Lattice& lattice, const Stroke& stroke)
{
  const glm::ivec3& dimensions = lattice.grid.dimensions;
  const glm::dvec3 rest = lattice.grid.gridFromWorld(tissueAt(lattice, stroke.anchor));
  const TapsOfAxes taps = tapsAround(dimensions, lattice.kernel, rest);
  double share = 0.0;
  forEachIndex(glm::ivec3(0), glm::ivec3(3), [&](const glm::ivec3& tap) {
    const glm::ivec3 at(taps[0].index[tap.x], taps[1].index[tap.y], taps[2].index[tap.z]);
    const double part =
      double(taps[0].weight[tap.x]) * double(taps[1].weight[tap.y]) * double(taps[2].weight[tap.z]);
    share += part * weightOf(lattice, stroke, at);
  });
  return share;
}

// The vector that the control points of a stroke follow by their weights. In a sphere it is longer
// than the stroke's, so that the tissue at the anchor follows the hand all the way.
glm::dvec3 vectorOfPoints(const Lattice& lattice, const Stroke& stroke)
{
  return shapeOf(stroke.tool) == StrokeShape::Sphere
    ? stroke.vector / std::clamp(shareAtAnchor(lattice, stroke), SmallestSoftFraction, 1.0)
    : stroke.vector;
}

void applyAround(Lattice& lattice, const Stroke& stroke)
{
  const Grid& grid = lattice.grid;
  const glm::dvec3 vector = vectorOfPoints(lattice, stroke);
  const std::int64_t layer = static_cast<std::int64_t>(grid.dimensions.x) * grid.dimensions.y;
  parallelFor(
    0, grid.dimensions.z, PointsAtLeast / layer, [&](std::int64_t first, std::int64_t last) {
      forEachIndex({ 0, 0, static_cast<int>(first) },
        { grid.dimensions.x - 1, grid.dimensions.y - 1, static_cast<int>(last) - 1 },
        [&](const glm::ivec3& at) {
          const double weight = weightOf(lattice, stroke, at);
          lattice.displacements[grid.offset(at.x, at.y, at.z)] += glm::vec3(weight * vector);
        });
    });
}
}

bool sameMask(
  const std::shared_ptr<const NodeWeights>& a, const std::shared_ptr<const NodeWeights>& b)
{
  return a == b || (a && b && a->perCell == b->perCell && a->values == b->values);
}

Lattice makeLattice(const Grid& grid, int kernel)
{
  Lattice lattice;
  lattice.grid = grid;
  lattice.kernel = kernel;
  lattice.displacements.assign(grid.count(), glm::vec3(0.0f));
  return lattice;
}

void requireLatticeSides(const glm::ivec3& sides)
{
  if (glm::any(glm::lessThan(sides, glm::ivec3(SmallestLatticeSide))) ||
    glm::any(glm::greaterThan(sides, glm::ivec3(LargestLatticeSide))))
  {
    std::ostringstream problem;
    problem << "Lattice Dimensions is " << sides.x << " x " << sides.y << " x " << sides.z
            << "; each side must have from " << SmallestLatticeSide << " to " << LargestLatticeSide
            << " points";
    throw Problem(problem.str());
  }
}

void requireDisplacements(const Lattice& lattice, const std::string& cause)
{
  const glm::dvec3& spacing = lattice.grid.spacing;
  const double longest = LongestDisplacementCells * std::min({ spacing.x, spacing.y, spacing.z });
  const auto tooLong = std::find_if_not(lattice.displacements.begin(), lattice.displacements.end(),
    [&](const glm::vec3& d) { return glm::length(glm::dvec3(d)) <= longest; });
  if (tooLong != lattice.displacements.end())
  {
    std::ostringstream problem;
    problem << "A control point is displaced by " << cause << " by "
            << glm::length(glm::dvec3(*tooLong)) << " mm; it must be at most " << longest << " mm, "
            << LongestDisplacementCells << " cells of the lattice";
    throw Problem(problem.str());
  }
}

void toBSplineCoefficients(const Grid& grid, std::vector<glm::dvec3>& values)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    glm::ivec3 last = grid.dimensions - 1;
    const int count = last[axis] + 1;
    last[axis] = 0;
    forEachIndex(glm::ivec3(0), last, [&](glm::ivec3 index) {
      std::vector<glm::dvec3> line;
      for (index[axis] = 0; index[axis] < count; ++index[axis])
      {
        line.push_back(values[grid.offset(index.x, index.y, index.z)]);
      }
      coefficientsAlong(line);
      for (index[axis] = 0; index[axis] < count; ++index[axis])
      {
        values[grid.offset(index.x, index.y, index.z)] = line[index[axis]];
      }
    });
  }
}

void applyStroke(Lattice& lattice, const Stroke& stroke)
{
  if (!stroke.enabled)
  {
    return;
  }
  if (shapeOf(stroke.tool) == StrokeShape::Point)
  {
    applyMove(lattice, stroke);
  }
  else
  {
    applyAround(lattice, stroke);
  }
}

glm::dvec3 displacementOfTissue(const Lattice& lattice, const glm::dvec3& rest)
{
  glm::vec3 displacement;
  glm::mat3 unused;
  const glm::dvec3 position = lattice.grid.gridFromWorld(rest);
  ForwardAround{ lattice, position }.map(glm::vec3(0.0f), displacement, unused);
  return lattice.grid.worldVectorFromGrid(glm::dvec3(displacement));
}

glm::dvec3 tissueAt(const Lattice& lattice, const glm::dvec3& deformed)
{
  const ForwardAround forward{ lattice, lattice.grid.gridFromWorld(deformed) };
  const glm::vec3 offset =
    Inversion<ForwardAround>{ forward }.inverseOffset(glm::vec3(0.0f), glm::vec3(0.0f));
  return deformed + lattice.grid.worldVectorFromGrid(glm::dvec3(offset));
}

double achievedDisplacement(const Lattice& before, const Lattice& after, const Stroke& stroke)
{
  const double length = glm::length(stroke.vector);
  if (!stroke.enabled || length == 0.0)
  {
    return 0.0;
  }
  glm::dvec3 rest;
  if (shapeOf(stroke.tool) == StrokeShape::Point)
  {
    const MadeAt madeAt(before.grid, stroke);
    rest = before.grid.worldFromGrid(madeAt.point * madeAt.ratio);
  }
  else
  {
    rest = tissueAt(before, stroke.anchor);
  }
  const glm::dvec3 moved = displacementOfTissue(after, rest) - displacementOfTissue(before, rest);
  return glm::dot(moved, stroke.vector) / length;
}

std::vector<glm::vec3> displacementsInCells(const Lattice& lattice)
{
  std::vector<glm::vec3> inCells(lattice.displacements.size());
  std::transform(lattice.displacements.begin(), lattice.displacements.end(), inCells.begin(),
    [&](const glm::vec3& displacement) {
      return glm::vec3(lattice.grid.gridVectorFromWorld(glm::dvec3(displacement)));
    });
  return inCells;
}

glm::vec3 cubicDisplacement(const glm::ivec3& dimensions, int kernel,
  const glm::vec3* displacements, const glm::dvec3& position)
{
  const TapsOfAxes taps = tapsAround(dimensions, kernel, position);
  glm::vec3 sum(0.0f);
  for (int k = 0; k < 4; ++k)
  {
    glm::vec3 plane(0.0f);
    for (int j = 0; j < 4; ++j)
    {
      plane +=
        taps[1].weight[j] * RowOfTaps(dimensions, displacements, taps, j, k).sum(taps[0].weight);
    }
    sum += taps[2].weight[k] * plane;
  }
  return sum;
}

glm::mat3 cubicGradient(const glm::ivec3& dimensions, int kernel, const glm::vec3* displacements,
  const glm::dvec3& position)
{
  const TapsOfAxes taps = tapsAround(dimensions, kernel, position);
  glm::mat3 gradient(0.0f);
  for (int k = 0; k < 4; ++k)
  {
    glm::mat3 plane(0.0f);
    for (int j = 0; j < 4; ++j)
    {
      const RowOfTaps row(dimensions, displacements, taps, j, k);
      const glm::vec3 value = row.sum(taps[0].weight);
      plane[0] += taps[1].weight[j] * row.sum(taps[0].slope);
      plane[1] += taps[1].slope[j] * value;
      plane[2] += taps[1].weight[j] * value;
    }
    gradient[0] += taps[2].weight[k] * plane[0];
    gradient[1] += taps[2].weight[k] * plane[1];
    gradient[2] += taps[2].slope[k] * plane[2];
  }
  return gradient;
}

CubicValue cubicValue(const glm::ivec3& dimensions, int kernel, const glm::vec4* displacements,
  const glm::dvec3& position)
{
  static const glm::mat4 kernels[] = { kernelPolynomials(KernelCatmullRom),
    kernelPolynomials(KernelBSpline) };
  const glm::mat4& polynomials = kernels[kernel == KernelBSpline];
  const FourTaps x = fourTapsAt(polynomials, dimensions.x, position.x);
  const FourTaps y = fourTapsAt(polynomials, dimensions.y, position.y);
  const FourTaps z = fourTapsAt(polynomials, dimensions.z, position.z);
  Four sum{};
  Four alongX{};
  Four alongY{};
  Four alongZ{};
  for (int k = 0; k < 4; ++k)
  {
    Four plane{};
    Four planeX{};
    Four planeY{};
    for (int j = 0; j < 4; ++j)
    {
      const glm::vec4* row = displacements +
        (static_cast<std::size_t>(z.index[k]) * dimensions.y + y.index[j]) * dimensions.x;
      Four value{};
      Four slope{};
      for (int i = 0; i < 4; ++i)
      {
        const Four tap = fourOf(row[x.index[i]]);
        value += x.weight[i] * tap;
        slope += x.slope[i] * tap;
      }
      plane += y.weight[j] * value;
      planeX += y.weight[j] * slope;
      planeY += y.slope[j] * value;
    }
    sum += z.weight[k] * plane;
    alongX += z.weight[k] * planeX;
    alongY += z.weight[k] * planeY;
    alongZ += z.slope[k] * plane;
  }
  return { threeOf(sum), glm::mat3(threeOf(alongX), threeOf(alongY), threeOf(alongZ)) };
}
}

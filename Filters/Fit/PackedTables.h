// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Pairs, pulls and pins as rows of numbers: the properties LandmarkPairs, Pulls and Pins of a Fit
/// Deformation.
#ifndef BrainShift_PackedTables_h
#define BrainShift_PackedTables_h

#include "Filters/Fit/Measurements.h"

namespace brainshift
{
/** Tissue that a hand put somewhere: `measured` is where it was put. */
using Pull = PointPair;

/** Tissue that stays. */
struct Pin
{
  glm::dvec3 rest{ 0.0 }; ///< mm, rest frame
  bool enabled = true;
};

/** How a row is packed. */
template <class Row>
struct Packed;

/** Rest xyz, measured xyz, weight. */
template <>
struct Packed<PointPair>
{
  static constexpr std::size_t Numbers = 7;
  static PointPair row(const double* n)
  {
    return { { n[0], n[1], n[2] }, { n[3], n[4], n[5] }, n[6] };
  }
  static std::vector<double> numbers(const PointPair& pair)
  {
    const glm::dvec3& from = pair.rest;
    const glm::dvec3& to = pair.measured;
    return { from.x, from.y, from.z, to.x, to.y, to.z, pair.weight };
  }
};

/** Rest xyz, enabled (1 or 0). */
template <>
struct Packed<Pin>
{
  static constexpr std::size_t Numbers = 4;
  static Pin row(const double* n) { return { { n[0], n[1], n[2] }, n[3] != 0.0 }; }
  static std::vector<double> numbers(const Pin& pin)
  {
    return { pin.rest.x, pin.rest.y, pin.rest.z, pin.enabled ? 1.0 : 0.0 };
  }
};

/** The rows of a list of numbers. Numbers of an incomplete row at the end do not count. */
template <class Row>
std::vector<Row> rowsFrom(const std::vector<double>& numbers)
{
  constexpr std::size_t each = Packed<Row>::Numbers;
  std::vector<Row> rows;
  rows.reserve(numbers.size() / each);
  for (std::size_t i = 0; i + each <= numbers.size(); i += each)
  {
    rows.push_back(Packed<Row>::row(&numbers[i]));
  }
  return rows;
}

template <class Row>
std::vector<double> numbersFrom(const std::vector<Row>& rows)
{
  std::vector<double> numbers;
  numbers.reserve(rows.size() * Packed<Row>::Numbers);
  for (const Row& row : rows)
  {
    const std::vector<double> some = Packed<Row>::numbers(row);
    numbers.insert(numbers.end(), some.begin(), some.end());
  }
  return numbers;
}

/**
 * Position in the list of the row whose tissue is nearest to `rest`, at most `radius` mm away. The
 * size of the list if there is none.
 */
template <class Row>
std::size_t nearest(const std::vector<Row>& rows, const glm::dvec3& rest, double radius)
{
  std::size_t found = rows.size();
  double least = radius;
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    const double distance = glm::distance(rows[i].rest, rest);
    if (distance <= least)
    {
      found = i;
      least = distance;
    }
  }
  return found;
}
}

#endif

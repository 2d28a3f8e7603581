// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The row and column of each contact of one electrode, by the numbers in labels or by positions.
#ifndef BrainShift_ContactOrder_h
#define BrainShift_ContactOrder_h

#include <glm/glm.hpp>

#include <optional>
#include <vector>

namespace brainshift
{
/** How numbers run over a sheet. The first one is in a corner. */
struct Numbering
{
  int rows = 1;
  int columns = 1;
  int first = 1;           ///< number of the first contact
  bool alternates = false; ///< whether every other row is numbered backwards
  bool operator==(const Numbering& other) const
  {
    return this->rows == other.rows && this->columns == other.columns &&
      this->first == other.first && this->alternates == other.alternates;
  }
};

/** Rows, columns and the place of each contact on a sheet. */
struct ContactOrder
{
  int rows = 0;
  int columns = 0;
  std::vector<std::optional<glm::ivec2>> places; ///< row and column, of the contacts in their order
};

/** The place of a number; none outside of the sheet. */
std::optional<glm::ivec2> placeOf(int number, const Numbering& numbering);

/** The number at a place. */
int numberAt(const glm::ivec2& place, const Numbering& numbering);

ContactOrder orderBy(const std::vector<int>& numbers, const Numbering& numbering);

/** Distances (mm) between neighbours in a row or a column. */
std::vector<double> neighbourDistances(
  const std::vector<glm::dvec3>& positions, const ContactOrder& order);

/** How many rows without contacts are before all others, and how many after them. */
glm::ivec2 emptyRows(const ContactOrder& order);

/** The number in the middle of a sorted list; 0 of an empty one. */
double median(std::vector<double> numbers);

/**
 * How badly positions agree with an order: the mean relative difference of distances between
 * neighbours, straight and diagonal, from what their median says, plus the fraction of contacts
 * beside which there is one that is no neighbour. 0: a flat sheet.
 */
double misfit(const std::vector<glm::dvec3>& positions, const ContactOrder& order);

/** A numbering and its misfit. */
struct RankedNumbering
{
  Numbering numbering;
  double misfit = 0.0;
};

/**
 * All numberings that a sheet of these numbers may have, the best one first. It may start at 1 or
 * at a higher number, as an electrode whose first rows are cut off, or that goes on after another
 * one.
 *
 * @param rows, columns   the shape if it is known, else 0. They may be exchanged
 */
std::vector<RankedNumbering> rankedNumberings(const std::vector<glm::dvec3>& positions,
  const std::vector<int>& numbers, int rows = 0, int columns = 0);

/**
 * The order that the positions have by themselves: the sheet is followed from neighbour to
 * neighbour. Contacts that do not follow have no place.
 */
ContactOrder orderOfPositions(const std::vector<glm::dvec3>& positions);
}

#endif

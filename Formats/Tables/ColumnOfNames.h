// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which column of a table holds the names of points, by what it is called and by its values.
#ifndef BrainShift_ColumnOfNames_h
#define BrainShift_ColumnOfNames_h

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace brainshift
{
/**
 * Looks at all records of a table, and then tells the column of names. In this order it is
 *
 * 1. `label` or `name`, if it has a value,
 * 2. one that is called so (electrode, contact, id, punkt) and whose values differ: words first,
 * 3. the first of words whose values differ, unless its name says what else it is,
 * 4. one that is called so and whose values repeat.
 */
class ColumnOfNames
{
public:
  /**
   * @param header   the names of all columns
   * @param taken    columns that mean something else
   */
  ColumnOfNames(const std::vector<std::string>& header, const std::vector<std::size_t>& taken);

  /** Looks at a record: the values of all columns, or fewer. */
  void add(const std::vector<std::string>& values);

  /** A column, and whether it is called neither label nor name. */
  struct Found
  {
    std::size_t at = 0;
    bool isGuessed = false;
  };

  /** The column; none if no column can hold names. */
  std::optional<Found> find() const;

private:
  struct Candidate
  {
    std::size_t at = 0;
    bool isPlain = false; // called label or name
    bool isKnown = false; // called as columns of names are
    bool isOther = false; // called as something else is
    bool hasWords = false;
    std::vector<std::size_t> hashes; // of the values

    bool differs() const;
  };

  std::vector<Candidate> Candidates;
};
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief The lines of a MetaImage ("key = value") or NRRD ("field: value") header, as words and
 *        numbers. What they mean is not known here.
 */
#ifndef BrainShift_HeaderText_h
#define BrainShift_HeaderText_h

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace brainshift
{
/** The lines of a header. */
struct HeaderText
{
  bool isNRRD = false;                       ///< the file begins with "NRRD"
  std::map<std::string, std::string> fields; ///< what the format defines
  std::map<std::string, std::string> keys;   ///< NRRD's "key:=value", which anybody may add
  std::vector<std::string> listed;           ///< the lines after a list of files is announced
  std::string comments;                      ///< NRRD's lines that begin with #
  std::size_t bytes = 0;                     ///< of the header

  /** Value of the first of some fields that the header has; empty if it has none. */
  std::string valueOf(const std::vector<std::string>& names) const;

  /** Value of one of NRRD's keys; empty without it. */
  std::string keyed(const std::string& name) const;
};

/** Reads the lines of a file. Returns the end of a sentence on why it cannot, or nothing. */
std::string readHeaderText(const std::string& fileName, HeaderText& text);
}

#endif

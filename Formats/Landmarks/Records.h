// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Records of tables of text, and the comments between them.
#ifndef BrainShift_Records_h
#define BrainShift_Records_h

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace brainshift
{
/** Records of values between separators. Quoted values may hold separators, quotes and lines. */
class RecordReader
{
public:
  RecordReader(std::string_view text, char separator)
    : Text(text)
    , Separator(separator)
  {
  }

  /** Takes the next record that has anything in it. False at the end. */
  bool next(std::vector<std::string>& values);

  /** The line on which the last record began, from 1 on. */
  std::size_t line() const { return this->Line; }

  /** Whether the text ended inside quotes. */
  bool endedInQuotes() const { return this->IsOpen; }

private:
  std::string_view Text;
  char Separator;
  std::size_t Place = 0;
  std::size_t Line = 0;
  std::size_t NextLine = 1;
  bool IsOpen = false;

  void take(std::vector<std::string>& values);
  void takeQuoted(std::string& value);
};

/** A value of a record, in quotes where it needs them. */
std::string recordValue(const std::string& value, char separator);

/** What a comment says: "# Coordinate System: LPS" has the key coordinatesystem. */
struct CommentEntry
{
  std::string key;   ///< small letters and digits; empty: the comment has no = or :
  std::string value; ///< without blanks around it
  std::string words; ///< all that is behind the #
};

/** Whether a record is a comment: it begins with #. */
bool isComment(const std::vector<std::string>& values);

/** The entry of a comment that was divided at commas. */
CommentEntry commentEntry(const std::vector<std::string>& values, char separator);
}

#endif

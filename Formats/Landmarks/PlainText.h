// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Text files of numbers and words. Numbers have a point, whatever the language of the user.
 */
#ifndef BrainShift_PlainText_h
#define BrainShift_PlainText_h

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace brainshift
{
/**
 * Reads a whole file, without the mark of UTF-8 at its beginning.
 *
 * @param limit   bytes that the file may have
 * @return the end of a sentence, after the name of the file, on why it cannot; empty if it can
 */
std::string readPlainText(const std::string& fileName, std::size_t limit, std::string& text);

/** The first bytes of a file, without the mark of UTF-8; empty if it cannot be read. */
std::string readBeginning(const std::string& fileName, std::size_t bytes);

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
}

#endif

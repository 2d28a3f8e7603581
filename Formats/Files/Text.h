// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Words of text files, whatever the language of the user.
#ifndef BrainShift_Text_h
#define BrainShift_Text_h

#include <glm/glm.hpp>

#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace brainshift
{
/** What a stream of the C++ library makes of some values: numbers with 6 digits. */
template <typename... Parts>
std::string joined(const Parts&... parts)
{
  std::ostringstream text;
  (text << ... << parts);
  return text.str();
}

/** Three numbers with all their digits, and what stands between them. */
std::string listText(const glm::dvec3& numbers, const char* between);

/** Text without the blanks around it: spaces, tabs and ends of lines. */
std::string trimmed(std::string_view text, std::string_view blanks = " \t\r\n");

/** The words of a text between spaces. */
std::vector<std::string> wordsIn(std::string_view text);

/** ASCII letters made small. */
std::string lowerCase(std::string text);

/** Whether a text ends so, in capitals or not. `end` has small letters. */
bool endsWith(const std::string& text, const std::string& end);

/** How many letters must be changed, added or left out to make one text of the other. */
std::size_t lettersBetween(const std::string& one, const std::string& other);

/**
 * Text whose lines end with a line feed. Where the first line ends with carriage returns alone, as
 * old Macs wrote them, each of them becomes one; no byte moves.
 */
std::string withLineFeeds(std::string text);

/** Words of a file as an error may show them: printable, and not too many. */
std::string shownWords(const std::string& words);

/** The end of a sentence about a file that must have a thing once: "has the key Offset twice". */
std::string twice(const std::string& thing);

/** Text in UTF-8 from one in Latin-1, of which each byte is a letter. */
std::string utf8OfLatin1(std::string_view text);

/** Text in UTF-8: each byte that belongs to no letter becomes the replacement character. */
std::string validUtf8(std::string_view text);
}

#endif

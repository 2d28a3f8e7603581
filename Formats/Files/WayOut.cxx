// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Files/WayOut.h"

#include "Formats/Files/Text.h"

#include <algorithm>
#include <iterator>
#include <string_view>

namespace brainshift
{
namespace
{
constexpr std::string_view Advice[] = { "add", "check", "choose", "close", "convert", "copy",
  "join", "leave", "let", "make", "name", "open", "reload", "resample", "save", "set", "turn",
  "unpack", "use", "write" };

// Whether a part of a sentence begins with a verb that tells the reader what to do.
bool isAdvice(const std::string& part)
{
  const std::string lower = lowerCase(part);
  return std::any_of(std::begin(Advice), std::end(Advice), [&lower](std::string_view verb) {
    return lower.compare(0, verb.size() + 1, std::string(verb) + " ") == 0;
  });
}
}

std::string badJson(const std::exception& error)
{
  const std::string said = error.what(); // "[json.exception.parse_error.101] parse error at ..."
  const std::size_t first = said.find(' ') + 1;
  return "is not good JSON: " + shownWords(said.substr(first, said.find("; check") - first));
}

std::string withWayOut(const std::string& reason, const std::string& wayOut)
{
  bool isThere = reason.find("was stopped") != std::string::npos;
  for (std::size_t at = reason.find_first_of(";."); at != std::string::npos;
    at = reason.find_first_of(";.", at + 1))
  {
    isThere = isThere || (reason[at + 1] == ' ' && isAdvice(reason.substr(at + 2)));
  }
  return isThere ? reason : reason + "; " + wayOut;
}
}

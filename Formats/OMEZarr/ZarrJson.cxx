// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/OMEZarr/ZarrJson.h"

#include "Common/Problem.h"
#include "Formats/Files/Text.h"
#include "Formats/Files/WayOut.h"

#include <cmath>

namespace brainshift
{
namespace
{
constexpr std::uint64_t MostBytes = std::uint64_t(1) << 24;
constexpr int MostDepth = 64;
constexpr std::size_t MostNumbers = 32; // as many axes as numpy takes

// Calls `visit` with the position of each letter that is in no text between quotation marks.
template <typename Visit>
void forEachOutside(const std::string& json, const Visit& visit)
{
  bool isInText = false;
  for (std::size_t i = 0; i < json.size(); ++i)
  {
    const char letter = json[i];
    i += isInText && letter == '\\' ? 1 : 0;
    isInText = isInText != (letter == '"');
    if (!isInText)
    {
      visit(i);
    }
  }
}

// Objects and lists in each other: a parser may need memory or a stack for each.
void requireDepth(const std::string& json)
{
  int depth = 0;
  forEachOutside(json, [&](std::size_t i) {
    throwIfAny(json[i] == '\0' ? "is not good JSON: it has a byte of 0" : "");
    depth += json[i] == '{' || json[i] == '[' ? 1 : 0;
    depth -= json[i] == '}' || json[i] == ']' ? 1 : 0;
    if (depth > MostDepth)
    {
      throw Problem(
        "has lists in lists more than " + std::to_string(MostDepth) + " deep, which is the limit");
    }
  });
}

// The same with marks around NaN and Infinity, which Python writes without them.
std::string withQuotedWords(const std::string& json)
{
  std::string quoted;
  std::size_t done = 0;
  forEachOutside(json, [&](std::size_t i) {
    for (const std::string word : { "NaN", "-Infinity", "Infinity" })
    {
      if (i >= done && json.compare(i, word.size(), word) == 0)
      {
        quoted += json.substr(done, i - done) + '"' + word + '"';
        done = i + word.size();
      }
    }
  });
  return quoted + json.substr(done);
}

[[noreturn]] void failNumbers(const Json& json, const std::string& name, const std::string& must)
{
  throw Problem("has the " + name + " " + shownJson(json) + "; it must be " + must);
}
}

std::optional<Json> readJson(const ZarrStore& store, const std::string& key)
{
  return withBeginning("has an entry '" + shownWords(key) + "' that ", [&] {
    const std::optional<std::string> text = store.read(key, MostBytes);
    if (!text)
    {
      return std::optional<Json>();
    }
    requireDepth(*text);
    try
    {
      Json json = Json::parse(withQuotedWords(*text));
      throwIfAny(json.is_object() ? "" : "is no object of JSON");
      return std::optional<Json>(std::move(json));
    }
    catch (const Json::exception& error)
    {
      throw Problem(badJson(error));
    }
  });
}

const Json& memberOf(const Json& object, const char* name)
{
  static const Json null;
  const auto found = object.is_object() ? object.find(name) : object.end();
  return found == object.end() ? null : *found;
}

std::string textIn(const Json& json, const std::string& otherwise)
{
  return json.is_string() ? json.get<std::string>() : otherwise;
}

std::string shownJson(const Json& json)
{
  // Bytes that are no UTF-8 must not throw here.
  return shownWords(json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

std::vector<std::int64_t> wholeNumbersIn(
  const Json& json, std::size_t count, std::int64_t least, const std::string& name)
{
  constexpr std::int64_t Most = std::int64_t(1) << 53;
  const std::string must = (count > 0 ? std::to_string(count) : std::string("1 to 32")) +
    " whole numbers from " + std::to_string(least) + " on";
  if (!json.is_array() || json.empty() || json.size() > MostNumbers ||
    (count > 0 && json.size() != count))
  {
    failNumbers(json, name, must);
  }
  std::vector<std::int64_t> numbers;
  for (const Json& entry : json)
  {
    const bool isWhole = entry.is_number_integer() &&
      !(entry.is_number_unsigned() && entry.get<std::uint64_t>() > std::uint64_t(Most));
    if (!isWhole || entry.get<std::int64_t>() < least)
    {
      failNumbers(json, name, must);
    }
    numbers.push_back(entry.get<std::int64_t>());
  }
  return numbers;
}

std::vector<double> realNumbersIn(const Json& json, std::size_t count, const std::string& name)
{
  std::vector<double> numbers;
  for (const Json& entry : json.is_array() ? json : Json::array())
  {
    numbers.push_back(entry.is_number() ? entry.get<double>() : std::nan(""));
    if (!std::isfinite(numbers.back()))
    {
      break;
    }
  }
  if (numbers.size() != count || !std::isfinite(numbers.back()))
  {
    failNumbers(json, name, std::to_string(count) + " finite numbers, one for each axis");
  }
  return numbers;
}
}

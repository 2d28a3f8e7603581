// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Landmarks/PointColumns.h"

#include "Common/Problem.h"
#include "Formats/Files/Text.h"

#include <algorithm>
#include <cctype>
#include <map>

namespace brainshift
{
namespace
{
using Names = std::vector<std::string>;

// What the letters of three columns mean, by their order.
constexpr std::array<const char*, 3> Kinds{ "xyz", "ras", "lps" };
constexpr std::size_t Plain = 0;

const std::map<std::string, double>& units()
{
  static const std::map<std::string, double> all{ { "mm", 1.0 }, { "millimeter", 1.0 },
    { "millimeters", 1.0 }, { "millimetre", 1.0 }, { "millimetres", 1.0 }, { "cm", 10.0 },
    { "centimeter", 10.0 }, { "centimeters", 10.0 }, { "centimetre", 10.0 },
    { "centimetres", 10.0 }, { "m", 1000.0 }, { "meter", 1000.0 }, { "meters", 1000.0 },
    { "metre", 1000.0 }, { "metres", 1000.0 }, { "um", 1e-3 }, { "\xc2\xb5m", 1e-3 },
    { "\xce\xbcm", 1e-3 }, { "micrometer", 1e-3 }, { "micrometers", 1e-3 }, { "micrometre", 1e-3 },
    { "micrometres", 1e-3 } };
  return all;
}

// Words that say nothing about the position.
bool isFiller(const std::string& word)
{
  constexpr const char* Fillers[] = { "coord", "coords", "coordinate", "coordinates", "pos",
    "position", "point", "points", "loc", "location" };
  return std::find(std::begin(Fillers), std::end(Fillers), word) != std::end(Fillers);
}

bool isSpace(const std::string& word)
{
  constexpr const char* Spaces[] = { "mni", "mni152", "mni305", "tal", "talairach" };
  return std::find(std::begin(Spaces), std::end(Spaces), word) != std::end(Spaces);
}

// Letters and digits between other signs, in small letters. What is beyond ASCII is a letter.
Names wordsOfName(const std::string& written)
{
  Names words(1);
  for (const char letter : lowerCase(written))
  {
    const auto code = static_cast<unsigned char>(letter);
    if (code >= 128 || std::isalnum(code))
    {
      words.back() += letter;
    }
    else if (!words.back().empty())
    {
      words.emplace_back();
    }
  }
  words.erase(std::remove(words.begin(), words.end(), ""), words.end());
  return words;
}

// What one name means: an axis of one of the kinds, and words that its partners must share.
struct Meaning
{
  char letter = 0; // x y z, r a s, l p s; 0: no position
  PointColumns rest;
  std::string others; // words besides the axis, to find the partners
};

char letterOf(const std::string& word)
{
  static const std::map<std::string, char> letters{ { "right", 'r' }, { "anterior", 'a' },
    { "superior", 's' }, { "left", 'l' }, { "posterior", 'p' }, { "0", 'x' }, { "1", 'y' },
    { "2", 'z' } };
  const auto found = letters.find(word);
  const bool isLetter = word.size() == 1 && std::string("xyzraslp").find(word) != std::string::npos;
  return found != letters.end() ? found->second : isLetter ? word[0] : '\0';
}

Meaning meaningOf(const std::string& written)
{
  Meaning meaning;
  bool isKnown = true;
  const Names words = wordsOfName(written);
  for (const std::string& word : words)
  {
    const auto unit = units().find(word);
    const char letter = letterOf(word);
    const bool isDigit = std::isdigit(static_cast<unsigned char>(word[0])) != 0;
    if (letter && (!isDigit || words.front() == "points"))
    {
      isKnown = isKnown && !meaning.letter;
      meaning.letter = letter;
      continue;
    }
    meaning.others += word == "mm" ? "" : word + " "; // mm is what no unit means, too
    if (unit != units().end())
    {
      meaning.rest.mm = unit->second;
    }
    else if (word == "ras" || word == "lps")
    {
      meaning.rest.axes = axesFrom(word);
    }
    else if (isSpace(word))
    {
      meaning.rest.axes = FileAxes::RAS;
      meaning.rest.space = word;
    }
    else
    {
      isKnown = isKnown && isFiller(word);
    }
  }
  return isKnown ? meaning : Meaning();
}

// The columns of one kind that share all other words, as a set for each of these.
void addSets(const Names& header, std::size_t kind, std::vector<PointColumns>& sets)
{
  std::map<std::string, std::array<Names, 3>> found; // names of each axis, by the other words
  std::map<std::string, PointColumns> columns;
  for (std::size_t i = 0; i < header.size(); ++i)
  {
    const Meaning meaning = meaningOf(header[i]);
    const std::size_t axis = std::string(Kinds[kind]).find(meaning.letter);
    if (!meaning.letter || axis == std::string::npos)
    {
      continue;
    }
    PointColumns& set = columns.emplace(meaning.others, meaning.rest).first->second;
    set.at[axis] = i;
    set.names[axis] = trimmed(header[i]);
    set.mm = set.mm ? set.mm : meaning.rest.mm;
    found[meaning.others][axis].push_back(header[i]);
  }
  for (auto& [others, set] : columns)
  {
    const std::array<Names, 3>& names = found[others];
    const bool isWhole =
      std::all_of(names.begin(), names.end(), [](const Names& axis) { return !axis.empty(); });
    const std::optional<FileAxes> own = kind == Plain ? set.axes : axesFrom(Kinds[kind]);
    if (!isWhole || (set.axes && own && *set.axes != *own))
    {
      continue;
    }
    for (const Names& axis : names)
    {
      throwIfAny(axis.size() > 1 ? "names the column " + shownWords(axis[0]) + " twice" : "");
    }
    set.axes = own;
    sets.push_back(set);
  }
}

std::string namesOf(const PointColumns& set)
{
  return set.names[0] + " " + set.names[1] + " " + set.names[2];
}

// The columns that a caller names.
PointColumns wantedIn(const Names& header, const Names& wanted)
{
  throwIfAny(wanted.size() == 3
      ? ""
      : "is read by " + std::to_string(wanted.size()) + " position columns; they must be 3");
  PointColumns set;
  std::array<Meaning, 3> meanings;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::string name = lowerCase(trimmed(wanted[axis]));
    const auto isIt = [&](const std::string& column) { return lowerCase(trimmed(column)) == name; };
    const auto found = std::find_if(header.begin(), header.end(), isIt);
    const auto count = std::count_if(header.begin(), header.end(), isIt);
    if (count != 1)
    {
      throw Problem("has the column " + shownWords(wanted[axis]) + " " + std::to_string(count) +
        " times; it must have it once");
    }
    set.at[axis] = static_cast<std::size_t>(found - header.begin());
    set.names[axis] = trimmed(*found);
    meanings[axis] = meaningOf(*found);
  }
  for (std::size_t kind = 0; kind < Kinds.size(); ++kind)
  {
    bool isKind =
      meanings[0].others == meanings[1].others && meanings[0].others == meanings[2].others;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      isKind = isKind && meanings[axis].letter == Kinds[kind][axis];
    }
    if (isKind)
    {
      set.mm = meanings[0].rest.mm;
      set.space = meanings[0].rest.space;
      set.axes = kind == Plain ? meanings[0].rest.axes : axesFrom(Kinds[kind]);
    }
  }
  return set;
}
}

std::optional<PointColumns> pointColumnsIn(const Names& header, const Names& wanted)
{
  if (!wanted.empty())
  {
    return wantedIn(header, wanted);
  }
  std::vector<PointColumns> sets;
  for (std::size_t kind = 0; kind < Kinds.size(); ++kind)
  {
    addSets(header, kind, sets);
  }
  // Names of one letter, in mm or without a unit, count before all others.
  const auto isPlain = [](const PointColumns& set) {
    return std::all_of(set.names.begin(), set.names.end(), [](const std::string& name) {
      const Names words = wordsOfName(name);
      return words.size() == 1 || (words.size() == 2 && words[1] == "mm");
    });
  };
  const auto end = std::stable_partition(sets.begin(), sets.end(), isPlain);
  const auto plain = static_cast<std::size_t>(end - sets.begin());
  if (sets.empty())
  {
    return std::nullopt;
  }
  if (plain == 1 || sets.size() == 1)
  {
    return sets.front();
  }
  throw Problem("has several positions: " + namesOf(sets[0]) + ", and " + namesOf(sets[1]) +
    "; name the three columns that count (Position Columns)");
}
}

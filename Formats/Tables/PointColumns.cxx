// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Tables/PointColumns.h"

#include "Common/Problem.h"
#include "Formats/Files/Text.h"
#include "Formats/Landmarks/CoordinateWords.h"

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
constexpr const char* Choose = "name the three columns that count (Position Columns)";
constexpr std::size_t Plain = 0;

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

// What one name means, and words that the partners of its column must share.
struct Meaning
{
  char letter = 0; // x y z, r a s, l p s; 0: no position
  char side = 0;   // r a s, l p s i beside or in place of the letter; 0: none, or several
  bool isNegative = false;
  std::optional<double> mm;
  std::optional<FileAxes> axes;
  std::string space;
  std::string counted; // a word for positions that are no lengths
  std::string unknown; // all other words, with a space after each
  std::string others;  // words besides the axis, to find the partners
};

bool isSide(char letter)
{
  return letter && std::string("raslpi").find(letter) != std::string::npos;
}

char letterOf(const std::string& word)
{
  static const std::map<std::string, char> letters{ { "right", 'r' }, { "anterior", 'a' },
    { "superior", 's' }, { "left", 'l' }, { "posterior", 'p' }, { "inferior", 'i' }, { "0", 'x' },
    { "1", 'y' }, { "2", 'z' } };
  const auto found = letters.find(word);
  const bool isLetter =
    word.size() == 1 && std::string("xyzraslpi").find(word) != std::string::npos;
  return found != letters.end() ? found->second : isLetter ? word[0] : '\0';
}

// Adds a word that names no axis.
void addWord(const std::string& word, bool hasUnit, Meaning& meaning)
{
  const std::optional<double> length = word == "in" && !hasUnit ? 25.4 : lengthOfUnit(word);
  meaning.others += word == "mm" ? "" : word + " "; // mm is what no unit means, too
  if (length)
  {
    meaning.mm = length;
  }
  else if (word == "ras" || word == "lps")
  {
    meaning.axes = axesFrom(word);
  }
  else if (isSpace(word))
  {
    meaning.axes = FileAxes::RAS;
    meaning.space = word;
  }
  else if (isNoLength(word))
  {
    meaning.counted = word;
    meaning.unknown += word + " ";
  }
  else if (!isFiller(word) && word != "in")
  {
    meaning.unknown += word + " ";
  }
}

Meaning meaningOf(const std::string& written)
{
  Meaning meaning;
  const std::string name = trimmed(written);
  const bool isLongMinus = name.compare(0, 3, "\xe2\x88\x92") == 0; // U+2212
  const Names words = wordsOfName(isLongMinus ? name.substr(3) : name);
  const bool hasUnit = std::any_of(words.begin(), words.end(),
    [](const std::string& word) { return lengthOfUnit(word).has_value(); });
  for (const std::string& word : words)
  {
    const char letter = letterOf(word);
    const bool isDigit = std::isdigit(static_cast<unsigned char>(word[0])) != 0;
    if (!letter || (isDigit && words.front() != "points"))
    {
      addWord(word, hasUnit, meaning);
      continue;
    }
    meaning.unknown += meaning.letter ? word + " " : "";
    meaning.side = !isSide(letter) ? meaning.side : meaning.side ? '\0' : letter;
    meaning.letter = meaning.letter && isSide(letter) ? meaning.letter : letter;
  }
  meaning.isNegative = isLongMinus || name.compare(0, 1, "-") == 0;
  meaning.unknown += !name.empty() && name.back() == '-' ? "- " : ""; // nobody knows which way
  return meaning;
}

// Names of one axis that have the same words beside it: a name that is there twice, or several
// positions of one frame, such as x y z and x_mm y_mm z_mm, of which none counts before the other.
void requireOneEach(const std::array<Names, 3>& names)
{
  const auto sameName = [](const std::string& one, const std::string& other) {
    return lowerCase(trimmed(one)) == lowerCase(trimmed(other));
  };
  for (const Names& axis : names)
  {
    throwIfAny(axis.size() > 1 && sameName(axis[0], axis[1])
        ? "names the column " + shownWords(axis[0]) + " twice"
        : "");
  }
  const auto listed = [&](std::size_t i) {
    return shownWords(names[0][i] + " " + names[1][i] + " " + names[2][i]);
  };
  const bool areSeveral =
    std::all_of(names.begin(), names.end(), [](const Names& axis) { return axis.size() > 1; });
  throwIfAny(areSeveral
      ? "has several positions: " + listed(0) + ", and " + listed(1) + std::string("; ") + Choose
      : "");
  for (const Names& axis : names)
  {
    throwIfAny(axis.size() > 1 ? "has two columns for one axis of its positions, " +
          shownWords(axis[0]) + " and " + shownWords(axis[1]) + "; " + Choose
                               : "");
  }
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
    if (!meaning.letter || axis == std::string::npos || !meaning.unknown.empty())
    {
      continue;
    }
    PointColumns& set = columns[meaning.others];
    set.at[axis] = i;
    set.names[axis] = trimmed(header[i]);
    set.signs[axis] = meaning.isNegative ? -1.0 : 1.0;
    set.axes = meaning.axes;
    set.space = meaning.space;
    if (meaning.mm)
    {
      set.mm.fill(meaning.mm);
    }
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
    requireOneEach(names);
    set.axes = own;
    sets.push_back(set);
  }
}

std::string namesOf(const PointColumns& set)
{
  return set.names[0] + " " + set.names[1] + " " + set.names[2];
}

std::string listOf(const PointColumns& set)
{
  return shownWords(set.names[0]) + ", " + shownWords(set.names[1]) + " and " +
    shownWords(set.names[2]);
}

using Meanings = std::array<Meaning, 3>;

// The axis to the right, front or head of a side, and its sign.
std::pair<std::size_t, double> axisOf(char side)
{
  const std::size_t axis = std::string("raslpi").find(side);
  return { axis % 3, axis < 3 ? 1.0 : -1.0 };
}

// Puts columns such as L, A and S in the order right, front, head. False if they name no sides.
bool turnToSides(const Meanings& meanings, PointColumns& set)
{
  const auto sides = std::count_if(
    meanings.begin(), meanings.end(), [](const Meaning& one) { return one.side != 0; });
  const bool isPlain = std::all_of(
    meanings.begin(), meanings.end(), [](const Meaning& one) { return !isSide(one.letter); });
  PointColumns turned = set;
  std::array<bool, 3> isSeen{};
  for (std::size_t i = 0; sides == 3 && i < 3; ++i)
  {
    const auto [axis, sign] = axisOf(meanings[i].side);
    isSeen[axis] = true;
    turned.at[axis] = set.at[i];
    turned.names[axis] = set.names[i];
    turned.mm[axis] = set.mm[i];
    turned.signs[axis] = sign * set.signs[i];
  }
  if (isSeen[0] && isSeen[1] && isSeen[2])
  {
    const double x = set.axes == FileAxes::LPS ? -1.0 : 1.0;
    const bool isContrary = set.axes && turned.signs != std::array<double, 3>{ x, x, 1.0 };
    throwIfAny(
      isContrary ? "has the columns " + listOf(set) + ", whose words contradict each other" : "");
    turned.axes = FileAxes::RAS;
    set = turned;
    return true;
  }
  throwIfAny(!isPlain && sides > 1 ? "has the columns " + listOf(set) +
        ", whose letters are no three axes to right or left, front or back, head or feet"
                                   : "");
  return false;
}

// Units of some columns only count for all if they are mm.
void agreeOnUnits(PointColumns& set)
{
  const auto& [x, y, z] = set.mm;
  const std::optional<double> any = x ? x : y ? y : z;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::optional<double> other =
      set.mm[(axis + 1) % 3] ? set.mm[(axis + 1) % 3] : set.mm[(axis + 2) % 3];
    throwIfAny(!set.mm[axis] && other && *other != 1.0 ? "names a unit for some of its columns " +
          listOf(set) + " only; name it in each, or in none"
                                                       : "");
  }
  for (std::optional<double>& mm : set.mm)
  {
    mm = mm ? mm : any;
  }
}

// What the words of the caller's columns say together.
void addMeanings(const Meanings& meanings, PointColumns& set)
{
  for (std::size_t i = 0; i < 3; ++i)
  {
    const Meaning& meaning = meanings[i];
    throwIfAny(meaning.counted.empty()
        ? ""
        : "has the column " + shownWords(set.names[i]) + ", whose positions are counted in " +
          meaning.counted + "; they must be lengths; " + Choose);
    throwIfAny(set.axes && meaning.axes && *set.axes != *meaning.axes
        ? "has the columns " + listOf(set) + ", of which some are RAS and some LPS; " + Choose
        : "");
    set.axes = set.axes ? set.axes : meaning.axes;
    set.mm[i] = meaning.mm;
    set.signs[i] = meaning.isNegative ? -1.0 : 1.0;
    set.space = set.space.empty() ? meaning.space : set.space;
  }
  agreeOnUnits(set);
  const bool isTurned = turnToSides(meanings, set);
  for (const Meaning& meaning : meanings)
  {
    for (const std::string& word : wordsIn(meaning.unknown))
    {
      const bool isNews = (" " + set.unknown + " ").find(" " + word + " ") == std::string::npos;
      const bool isAxis = letterOf(word) != 0 && (isTurned || !isSide(letterOf(word)));
      const bool isSaid = isNews && !isAxis && (word.size() > 1 || isSide(word[0]) || word == "-");
      set.unknown += isSaid ? (set.unknown.empty() ? "" : " ") + word : "";
    }
  }
}

// The columns that a caller names.
PointColumns wantedIn(const Names& header, const Names& wanted)
{
  throwIfAny(wanted.size() == 3
      ? ""
      : "is read by " + std::to_string(wanted.size()) + " position columns; they must be 3");
  PointColumns set;
  Meanings meanings;
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
  addMeanings(meanings, set);
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
    std::string("; ") + Choose);
}
}

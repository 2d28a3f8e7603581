// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Landmarks/CoordinateWords.h"

#include "Common/Numbers.h"
#include "Common/Problem.h"
#include "Formats/Files/Text.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <map>
#include <numeric>

namespace brainshift
{
namespace
{
constexpr const char* NotKnown = "which is not known; check its axes and its origin";

template <std::size_t Count>
bool isOneOf(const std::string& word, const char* const (&words)[Count])
{
  return std::find(std::begin(words), std::end(words), word) != std::end(words);
}

template <std::size_t Count>
bool beginsAsOneOf(const std::string& word, const char* const (&words)[Count])
{
  return std::any_of(std::begin(words), std::end(words),
    [&](const std::string& begin) { return word.compare(0, begin.size(), begin) == 0; });
}

// The frame that a word names. None if it is not known.
std::optional<FrameMeaning> frameOf(const std::string& word)
{
  const std::string key = keyOf(word);
  constexpr const char* Scanner[] = { "ras", "scanras", "scannerras", "scanner", "scan" };
  constexpr const char* Lps[] = { "lps", "scanlps", "scannerlps", "dicom" };
  constexpr const char* Front[] = { "ctf", "eeglab", "eeglabhj", "kityokogawa", "yokogawa", "kit",
    "4dbti", "bti", "4d" };
  constexpr const char* Heads[] = { "captrak", "elektaneuromag", "neuromag", "elekta", "chietiitab",
    "itab", "besa" };
  constexpr const char* Templates[] = { "mni", "icbm", "ixi549", "fsaverage", "fslr", "nihpd",
    "oasis", "talairach", "uncinfant" };
  constexpr const char* Surfaces[] = { "tkras", "tkrras", "tkreg", "tkr", "surfaceras" };
  throwIfAny(isNoLength(key)
      ? "says that the positions are " + shownWords(word) + "; they must be lengths"
      : "");
  throwIfAny(isOneOf(key, Front) ? "says the coordinate system " + shownWords(word) +
        ", whose x points to the front; turn the positions to the right, front and head (RAS)"
                                 : "");
  if (isOneOf(key, Scanner) || isOneOf(key, Lps))
  {
    return FrameMeaning{ isOneOf(key, Lps) ? FileAxes::LPS : FileAxes::RAS, "" };
  }
  const std::string doubt = isOneOf(key, Heads)
    ? "whose origin is between the ears, not that of the scanner"
    : key == "acpc" ? "whose origin is the anterior commissure, not that of the scanner"
    : beginsAsOneOf(key, Templates) || key == "tal"
    ? "which is that of a template, not of the scanner"
    : isOneOf(key, Surfaces) ? "which is that of a surface of FreeSurfer, not of the scanner"
                             : "";
  return doubt.empty() ? std::nullopt : std::optional<FrameMeaning>({ FileAxes::RAS, doubt });
}

// Words between blanks and other signs.
std::vector<std::string> partsOf(std::string words)
{
  const auto isBetween = [](char letter) {
    return std::string(",;:=()[]\"'").find(letter) != std::string::npos;
  };
  std::replace_if(words.begin(), words.end(), isBetween, ' ');
  return wordsIn(words);
}

template <typename Value>
std::optional<Value> agreedOn(
  const std::optional<Value>& one, const std::optional<Value>& other, const char* what)
{
  throwIfAny(one && other && *one != *other
      ? std::string("contradicts itself: two ") + what + " for one position"
      : "");
  return one ? one : other;
}
}

std::optional<double> lengthOfUnit(const std::string& word)
{
  static const std::map<std::string, double> lengths{ { "mm", 1.0 }, { "millimeter", 1.0 },
    { "millimeters", 1.0 }, { "millimetre", 1.0 }, { "millimetres", 1.0 }, { "cm", 10.0 },
    { "centimeter", 10.0 }, { "centimeters", 10.0 }, { "centimetre", 10.0 },
    { "centimetres", 10.0 }, { "m", 1000.0 }, { "meter", 1000.0 }, { "meters", 1000.0 },
    { "metre", 1000.0 }, { "metres", 1000.0 }, { "um", 1e-3 }, { "\xc2\xb5m", 1e-3 },
    { "\xce\xbcm", 1e-3 }, { "micrometer", 1e-3 }, { "micrometers", 1e-3 }, { "micrometre", 1e-3 },
    { "micrometres", 1e-3 }, { "inch", 25.4 }, { "inches", 25.4 } };
  const auto found = lengths.find(word);
  return found == lengths.end() ? std::nullopt : std::optional<double>(found->second);
}

bool isNoLength(const std::string& word)
{
  constexpr const char* Words[] = { "vox", "voxel", "voxels", "px", "pixel", "pixels", "ijk",
    "index", "indices", "slice", "row", "column", "deg", "degrees", "km", "ft", "feet", "foot" };
  return std::find(std::begin(Words), std::end(Words), word) != std::end(Words);
}

std::optional<double> lengthUnder(
  const std::string& key, const std::string& words, LandmarkList& list)
{
  std::optional<double> length;
  bool isOne = true;
  bool isCounted = false;
  for (const std::string& part : partsOf(lowerCase(words)))
  {
    const std::optional<double> found = lengthOfUnit(part);
    isOne = isOne && (!length || !found || *length == *found);
    isCounted = isCounted || isNoLength(part);
    length = length ? length : found;
  }
  const std::string says = "says the unit " + shownWords(words);
  const bool isOfOther = keyOf(key).compare(0, 4, "unit") == 0; // such as kOhm
  throwIfAny(!isOne || isCounted || (!length && !isOfOther)
      ? says + "; it must be mm, cm, m, um or inch"
      : "");
  if (!length)
  {
    noteOnce(list, says + ", which is no length; its positions count as if it said none");
  }
  return length;
}

bool namesLength(const std::string& words)
{
  const std::vector<std::string> parts = partsOf(lowerCase(words));
  return std::any_of(parts.begin(), parts.end(),
    [](const std::string& part) { return lengthOfUnit(part).has_value(); });
}

FrameMeaning frameIn(const std::string& words)
{
  if (const std::optional<FrameMeaning> whole = frameOf(words))
  {
    return *whole;
  }
  std::optional<FrameMeaning> found;
  int count = 0;
  for (const std::string& part : partsOf(words))
  {
    if (const std::optional<FrameMeaning> frame = frameOf(part))
    {
      found = frame;
      ++count;
    }
  }
  return count == 1 && found ? *found : FrameMeaning{ std::nullopt, NotKnown };
}

void noteDoubt(const std::string& words, const FrameMeaning& frame, LandmarkList& list)
{
  if (!frame.doubt.empty())
  {
    noteOnce(list, "says the coordinate system " + shownWords(words) + ", " + frame.doubt);
  }
}

SaidOfPositions agreed(const SaidOfPositions& one, const SaidOfPositions& other)
{
  return { agreedOn(one.axes, other.axes, "kinds of axes (RAS and LPS)"),
    agreedOn(one.mm, other.mm, "units") };
}

SaidOfPositions saidByWords(const std::string& comment, bool isBelow, LandmarkList& list)
{
  constexpr const char* Fillers[] = { "all", "and", "are", "axes", "convention", "coordinate",
    "coordinates", "frame", "in", "is", "of", "orientation", "point", "points", "position",
    "positions", "scanner", "space", "system", "the", "unit", "units", "world", "x", "xyz", "y",
    "z" };
  constexpr const char* Others[] = { "voxel", "voxels", "vox", "ijk", "pixel", "pixels", "mni",
    "mni152", "mni305", "talairach", "fsaverage", "tkras", "tkrras", "tkreg", "tkr" };
  const std::vector<std::string> parts = partsOf(comment);
  std::vector<SaidOfPositions> all;
  all.reserve(parts.size());
  bool isPlain = !isBelow || parts.size() > 1;
  bool isDoubtful = false; // a word would change the positions
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    const std::string word = trimmed(lowerCase(parts[i]), ".");
    const bool isMeasure = parts[i] == "M" || (i > 0 && numberIn(parts[i - 1])); // such as 2 cm
    const std::optional<double> mm = isMeasure ? std::nullopt : lengthOfUnit(word);
    const bool isAxes = word == "ras" || word == "lps";
    all.push_back({ isAxes ? std::optional(axesFrom(word)) : std::nullopt, mm });
    isPlain = isPlain && (word.empty() || mm || isAxes || isOneOf(word, Fillers));
    isDoubtful = isDoubtful || word == "lps" || isOneOf(word, Others) ||
      (mm && *mm != 1.0 && word != "m"); // as in "I'm"
  }
  if (isPlain)
  {
    return std::accumulate(all.begin(), all.end(), SaidOfPositions(), agreed);
  }
  if (isDoubtful)
  {
    noteOnce(list,
      "has the comment \"" + shownWords(comment) +
        "\", which does not count; if it is about the positions, write it as \"# units: cm\" or "
        "\"# CoordinateSystem: LPS\"");
  }
  return {};
}

bool saysUnit(const std::string& key)
{
  constexpr const char* Keys[] = { "unit", "units", "coordinateunit", "coordinateunits",
    "coordinatesunit", "coordinatesunits", "coordunit", "coordunits", "positionunit",
    "positionunits", "lengthunit", "lengthunits" };
  return isOneOf(key, Keys);
}

bool saysFrame(const std::string& key)
{
  constexpr const char* Keys[] = { "coordinatesystem", "coordinatesystems", "coordsystem",
    "coordsys", "coordinatespace", "coordinateframe", "space", "frame", "referenceframe", "axes",
    "worldaxes", "orientation", "anatomicalorientation", "convention" };
  return isOneOf(key, Keys);
}

std::string keyOf(const std::string& name)
{
  std::string key = lowerCase(name);
  const auto isOther = [](char letter) {
    const auto code = static_cast<unsigned char>(letter);
    return code < 128 && !std::isalnum(code);
  };
  key.erase(std::remove_if(key.begin(), key.end(), isOther), key.end());
  return key;
}
}

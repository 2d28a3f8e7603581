// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Slicer's markups (.mrk.json): lists of control points that name their axes.
///
/// Points that Slicer has not placed ("positionStatus" other than "defined", no "position") are
/// left out and noted. Of the schema only the control points are read. A list that names no
/// coordinate system is LPS, the schema's default.
#include "Common/Numbers.h"
#include "Common/Problem.h"
#include "Formats/Files/Text.h"
#include "Formats/Files/WayOut.h"
#include "Formats/Landmarks/LandmarkFormats.h"

#include "vtk_nlohmannjson.h"
#include VTK_NLOHMANN_JSON(json.hpp)

#include <cstdint>
#include <exception>
#include <set>

namespace brainshift
{
namespace
{
constexpr const char* Schema =
  "https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/Markups/Resources/"
  "Schema/markups-schema-v1.0.3.json#";

// A word, a number, or neither: true, false and null.
struct Value
{
  const std::string* word = nullptr;
  const double* number = nullptr;
  bool isNull = false;
};

// Receives what the parser finds, and keeps only what makes points: a large file needs no more
// memory than they do. The public names are those that the parser calls. Each returns true, to go
// on, or throws.
class MarkupsHandler
{
public:
  explicit MarkupsHandler(LandmarkList& list)
    : List(list)
  {
  }

  // After the parser has ended.
  void finish()
  {
    throwIfAny(this->HasMarkups ? "" : "has no array \"markups\"; it is no markups file of Slicer");
    noteSkipped(this->List, this->Skipped);
  }

  bool null() { return this->take({ nullptr, nullptr, true }); }
  bool boolean(bool) { return this->take({}); }
  bool number_integer(std::int64_t number) { return this->takeNumber(static_cast<double>(number)); }
  bool number_unsigned(std::uint64_t number)
  {
    return this->takeNumber(static_cast<double>(number));
  }
  bool number_float(double number, const std::string&) { return this->takeNumber(number); }
  bool string(const std::string& word) { return this->take({ &word, nullptr, false }); }
  bool binary(const nlohmann::json::binary_t&) { return true; } // JSON has none

  bool key(const std::string& name)
  {
    this->Key = name;
    const Place place = this->Places.back();
    if (place != Place::Other && !this->Keys.back().insert(name).second)
    {
      throw Problem(
        (place == Place::Control ? beginningAt("control point " + std::to_string(this->Read))
                                 : std::string()) +
        twice("key " + shownWords(name)));
    }
    return true;
  }

  bool start_object(std::size_t) { return this->open(false); }
  bool start_array(std::size_t) { return this->open(true); }
  bool end_array() { return this->close(); }
  bool end_object() { return this->close(); }

  bool parse_error(std::size_t, const std::string&, const std::exception& error)
  {
    throw Problem(badJson(error));
  }

private:
  enum class Place // inside of what
  {
    Root,
    Markups,
    Markup,
    Units,
    Controls,
    Control,
    Position,
    Other,
  };

  LandmarkList& List;
  std::vector<Place> Places;               // from the outside to the inside
  std::vector<std::set<std::string>> Keys; // likewise: those of each object that came so far
  std::string Key;
  bool HasMarkups = false;
  std::size_t Read = 0;
  std::size_t Skipped = 0;
  std::size_t UnitWords = 0;
  // Of the list that is being read.
  FileAxes Axes = FileAxes::LPS;
  std::size_t First = 0;
  // Of the control point that is being read.
  Landmark Point;
  std::vector<double> Position;
  bool IsPlaced = true;

  [[noreturn]] void failPoint(const std::string& problem) const
  {
    throw Problem(beginningAt("control point " + std::to_string(this->Read)) + problem);
  }

  bool takeNumber(double number) { return this->take({ nullptr, &number, false }); }

  bool take(const Value& value)
  {
    switch (this->Places.empty() ? Place::Other : this->Places.back())
    {
      case Place::Root:
        this->refuseCoordinates();
        break;
      case Place::Markups:
        throw Problem("has a list of markups that is no object");
      case Place::Markup:
        this->takeOfMarkup(value);
        break;
      case Place::Units:
        this->takeUnit(value);
        break;
      case Place::Controls:
        ++this->Read;
        this->failPoint("is no object");
      case Place::Control:
        this->takeOfControl(value);
        break;
      case Place::Position:
        this->requirePosition(value.number != nullptr);
        this->Position.push_back(*value.number);
        break;
      default:
        break;
    }
    return true;
  }

  // Of the three words that a unit may have: its code, the scheme of the code, and its name.
  void takeUnit(const Value& value)
  {
    const std::size_t word = this->UnitWords++;
    if (word == 0)
    {
      requireUnit(value);
    }
    else if (word == 1 && !value.isNull && !(value.word && *value.word == "UCUM"))
    {
      throw Problem("has coordinateUnits of a scheme other than UCUM");
    }
  }

  static void requireUnit(const Value& value)
  {
    if (!value.isNull && !(value.word && *value.word == "mm"))
    {
      throw Problem("has coordinateUnits other than mm");
    }
  }

  void requirePosition(bool isGood) const
  {
    if (!isGood)
    {
      this->failPoint("has a position that is not 3 numbers");
    }
  }

  // A key in other letters would count as missing without a word.
  void requireKey(const std::string& known) const
  {
    if (this->Key != known && lowerCase(this->Key) == lowerCase(known))
    {
      throw Problem("has the key " + shownWords(this->Key) + "; Slicer writes " + known);
    }
  }

  // Axes and units at another place would count for nothing without a word.
  void refuseCoordinates() const
  {
    const std::string key = lowerCase(this->Key);
    throwIfAny(key == "coordinatesystem" || key == "coordinateunits" ? "has the key " +
          shownWords(this->Key) + " at a wrong place; Slicer writes it in each list"
                                                                     : "");
  }

  void takeOfMarkup(const Value& value)
  {
    this->requireKey("coordinateUnits");
    this->requireKey("coordinateSystem");
    this->requireKey("controlPoints");
    if (this->Key == "coordinateUnits")
    {
      requireUnit(value);
    }
    else if (this->Key == "coordinateSystem" && !value.isNull)
    {
      this->Axes = axesFrom(value.word ? *value.word
          : value.number               ? numberText(*value.number)
                                       : "");
    }
    else if (this->Key == "controlPoints" && !value.isNull)
    {
      throw Problem("has controlPoints that are no array");
    }
  }

  void takeOfControl(const Value& value)
  {
    this->requireKey("position");
    this->requireKey("positionStatus");
    this->requireKey("label");
    this->refuseCoordinates();
    if (this->Key == "label" && (value.word || value.number))
    {
      this->Point.label = value.word ? *value.word : numberText(*value.number);
    }
    else if (this->Key == "positionStatus" && value.word)
    {
      this->IsPlaced = *value.word == "defined";
    }
    this->requirePosition(this->Key != "position" || value.isNull);
  }

  bool open(bool isArray)
  {
    const Place outside = this->Places.empty() ? Place::Other : this->Places.back();
    const bool isRoot = this->Places.empty();
    this->Places.push_back(isRoot && !isArray ? Place::Root : Place::Other);
    this->Keys.emplace_back();
    if (outside == Place::Root && this->Key == "markups" && isArray)
    {
      this->Places.back() = Place::Markups;
      this->HasMarkups = true;
    }
    else if (outside == Place::Markups)
    {
      throwIfAny(isArray ? "has a list of markups that is no object" : "");
      this->enterMarkup();
    }
    else if (outside == Place::Markup)
    {
      this->openInMarkup(isArray);
    }
    else if (outside == Place::Controls)
    {
      this->enterControl(isArray);
    }
    else if (outside == Place::Control && this->Key != "position" &&
      lowerCase(this->Key) == "position")
    {
      this->requireKey("position");
    }
    else if (outside == Place::Position || (outside == Place::Control && this->Key == "position"))
    {
      this->requirePosition(outside == Place::Control && isArray);
      this->Places.back() = Place::Position;
      this->Position.clear();
    }
    return true;
  }

  void openInMarkup(bool isArray)
  {
    this->requireKey("controlPoints");
    if (this->Key == "controlPoints")
    {
      throwIfAny(isArray ? "" : "has controlPoints that are no array");
      this->Places.back() = Place::Controls;
    }
    else if (this->Key == "coordinateUnits")
    {
      throwIfAny(isArray ? "" : "has coordinateUnits other than mm");
      this->Places.back() = Place::Units;
      this->UnitWords = 0;
    }
    else if (this->Key == "coordinateSystem")
    {
      axesFrom(""); // throws
    }
  }

  void enterMarkup()
  {
    this->Places.back() = Place::Markup;
    this->Axes = FileAxes::LPS;
    this->First = this->List.points.size();
  }

  void enterControl(bool isArray)
  {
    ++this->Read;
    if (isArray)
    {
      this->failPoint("is no object");
    }
    this->Places.back() = Place::Control;
    this->Point = Landmark();
    this->Point.number = static_cast<double>(this->Read);
    this->Position.clear();
    this->IsPlaced = true;
  }

  bool close()
  {
    const Place place = this->Places.back();
    this->Places.pop_back();
    this->Keys.pop_back();
    if (place == Place::Markup) // its axes may be named after its points
    {
      for (std::size_t i = this->First; i < this->List.points.size(); ++i)
      {
        this->List.points[i].position = inAxes(this->Axes, this->List.points[i].position);
      }
    }
    if (place == Place::Control)
    {
      this->addPoint();
    }
    return true;
  }

  void addPoint()
  {
    if (!this->IsPlaced || this->Position.empty())
    {
      ++this->Skipped;
      return;
    }
    this->requirePosition(this->Position.size() == 3);
    this->Point.position = { this->Position[0], this->Position[1], this->Position[2] };
    addLandmark(this->List, this->Point, "control point " + std::to_string(this->Read));
  }
};

void readMarkups(const std::string& text, const LandmarkChoice& /*choice*/, LandmarkList& list)
{
  MarkupsHandler handler(list);
  nlohmann::json::sax_parse(text, &handler);
  handler.finish();
}

bool looksLikeMarkups(const std::string& beginning)
{
  const std::string text = trimmed(beginning);
  return !text.empty() && text[0] == '{' && text.find("\"markups\"") != std::string::npos;
}

std::string jsonWord(const std::string& word)
{
  std::string quoted = "\"";
  for (const char letter : validUtf8(word))
  {
    if (letter == '"' || letter == '\\')
    {
      quoted += '\\';
      quoted += letter;
    }
    else if (letter >= 0 && letter < ' ')
    {
      constexpr const char* Digits = "0123456789abcdef";
      quoted += "\\u00";
      quoted += Digits[letter / 16];
      quoted += Digits[letter % 16];
    }
    else
    {
      quoted += letter;
    }
  }
  return quoted + '"';
}

// One list of the type Fiducial.
void writeMarkups(std::ostream& file, FileAxes axes, LandmarkList& list)
{
  file << "{\n  \"@schema\": \"" << Schema << "\",\n  \"markups\": [\n    {\n"
       << "      \"type\": \"Fiducial\",\n"
       << "      \"coordinateSystem\": \"" << (axes == FileAxes::RAS ? "RAS" : "LPS") << "\",\n"
       << "      \"coordinateUnits\": \"mm\",\n      \"controlPoints\": [";
  for (std::size_t i = 0; i < list.points.size(); ++i)
  {
    const glm::dvec3 position = inAxes(axes, list.points[i].position);
    file << (i > 0 ? ",\n" : "\n") << "        { \"id\": \"" << std::to_string(i + 1)
         << "\", \"label\": " << jsonWord(list.points[i].label)
         << ", \"description\": \"\", \"associatedNodeID\": \"\", \"position\": ["
         << numberText(position.x) << ", " << numberText(position.y) << ", "
         << numberText(position.z)
         << "], \"orientation\": [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0], "
            "\"selected\": true, \"locked\": false, \"visibility\": true, "
            "\"positionStatus\": \"defined\" }";
  }
  file << "\n      ]\n    }\n  ]\n}\n";
}
}

extern const LandmarkFormat LandmarksOfMarkups{ []() -> std::vector<std::string> {
                                                 return { ".mrk.json", ".json" };
                                               },
  looksLikeMarkups, readMarkups, writeMarkups, FileAxes::LPS, /*hasOneFrame=*/false,
  /*isUtf8=*/true, /*holdsNumbers=*/false };
}

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// MNI Tag Point Files (.tag): homologous points in one or two volumes, RAS, mm.
///
/// After the coordinates a point may have three numbers (weight, structure, patient), which are
/// passed over, and a label in quotes. A label cannot hold the quotes around it, nor a new line.
#include "Common/Numbers.h"
#include "Common/Problem.h"
#include "Formats/Files/Text.h"
#include "Formats/Landmarks/LandmarkFormats.h"

#include <algorithm>
#include <cmath>

namespace brainshift
{
namespace
{
constexpr std::string_view Magic = "MNI Tag Point File";
constexpr std::size_t NumbersAfter = 3; // weight, structure, patient

// Words of the file: quoted text without its quotes, "=", ";", ends of lines, and all else.
class Words
{
public:
  explicit Words(std::string_view text)
    : Text(text)
  {
  }

  enum class Kind
  {
    End,
    Line,
    Mark, // = or ;
    Quoted,
    Open, // quotes that do not end in their line
    Word,
  };

  Kind next(std::string& word)
  {
    this->skipBlanks();
    word.clear();
    if (this->Place >= this->Text.size())
    {
      return Kind::End;
    }
    const char first = this->Text[this->Place];
    if (first == '\n')
    {
      ++this->Place;
      ++this->Line;
      return Kind::Line;
    }
    if (first == '=' || first == ';')
    {
      ++this->Place;
      word = first;
      return Kind::Mark;
    }
    return first == '"' || first == '\'' ? this->takeQuoted(first, word) : this->takeWord(word);
  }

  std::size_t line() const { return this->Line; }

private:
  std::string_view Text;
  std::size_t Place = 0;
  std::size_t Line = 1;

  void skipBlanks()
  {
    while (this->Place < this->Text.size())
    {
      const char letter = this->Text[this->Place];
      if (letter == '%' || letter == '#')
      {
        this->Place = std::min(this->Text.find('\n', this->Place), this->Text.size());
      }
      else if (letter == ' ' || letter == '\t' || letter == '\r')
      {
        ++this->Place;
      }
      else
      {
        return;
      }
    }
  }

  Kind takeQuoted(char quote, std::string& word)
  {
    const char ends[] = { quote, '\n' };
    const std::size_t begin = this->Place + 1;
    const std::size_t end =
      std::min(this->Text.find_first_of(std::string_view(ends, 2), begin), this->Text.size());
    word = this->Text.substr(begin, end - begin);
    const bool isClosed = end < this->Text.size() && this->Text[end] == quote;
    this->Place = isClosed ? end + 1 : end;
    return isClosed ? Kind::Quoted : Kind::Open;
  }

  Kind takeWord(std::string& word)
  {
    const std::size_t end =
      std::min(this->Text.find_first_of(" \t\r\n=;\"'%#", this->Place), this->Text.size());
    word = this->Text.substr(this->Place, end - this->Place);
    this->Place = end;
    return Kind::Word;
  }
};

// Reads "name = value ;" or "name =". Ends of lines may stand in between.
void expect(Words& words, std::string_view wanted)
{
  std::string word;
  Words::Kind kind = Words::Kind::Line;
  while (kind == Words::Kind::Line)
  {
    kind = words.next(word);
  }
  if (!(word == wanted && kind != Words::Kind::Quoted))
  {
    throw Problem("has \"" + shownWords(word) + "\" in line " + std::to_string(words.line()) +
      "; it must have " + std::string(wanted));
  }
}

// Returns the number of volumes.
std::size_t readHeader(Words& words)
{
  expect(words, "Volumes");
  expect(words, "=");
  std::string count;
  words.next(count);
  if (count != "1" && count != "2")
  {
    throw Problem("has points of " + shownWords(count) + " volumes; it must have 1 or 2");
  }
  expect(words, ";");
  expect(words, "Points");
  expect(words, "=");
  return count == "1" ? 1 : 2;
}

// The points, as far as they have been read.
struct Reading
{
  std::size_t coordinates = 3; // of a point, in all volumes
  std::size_t offset = 0;      // of those that are wanted
  std::vector<double> numbers; // of the point that is being read
  std::string label;

  bool isWhole() const { return this->numbers.size() >= this->coordinates; }

  // Takes the point that is being read, if there is one.
  void finish(LandmarkList& list, std::size_t line)
  {
    const std::string where = "line " + std::to_string(line);
    const std::size_t count = this->numbers.size();
    if (count == 0 && this->label.empty())
    {
      return;
    }
    if (count != this->coordinates && count != this->coordinates + NumbersAfter)
    {
      throw Problem("has " + std::to_string(count) + " numbers for a point in " + where +
        "; it must have " + std::to_string(this->coordinates) + ", and 3 more or none");
    }
    Landmark point;
    point.number = static_cast<double>(list.points.size() + 1);
    point.position = { this->numbers[this->offset], this->numbers[this->offset + 1],
      this->numbers[this->offset + 2] };
    point.label = validUtf8(this->label);
    this->numbers.clear();
    this->label.clear();
    addLandmark(list, point, where);
  }
};

void readPoints(Words& words, Reading& reading, LandmarkList& list)
{
  std::string word;
  while (true)
  {
    const Words::Kind kind = words.next(word);
    if (kind == Words::Kind::Mark && word == ";")
    {
      reading.finish(list, words.line());
      return;
    }
    if (kind == Words::Kind::Word && reading.numbers.size() < reading.coordinates + NumbersAfter)
    {
      const std::optional<double> number = numberIn(word);
      reading.numbers.push_back(number.value_or(0.0));
      if (!std::isfinite(number.value_or(NAN)))
      {
        throw Problem("has \"" + shownWords(word) + "\" in place of a number");
      }
    }
    else if (kind == Words::Kind::Quoted && reading.isWhole())
    {
      reading.label = word;
      reading.finish(list, words.line());
    }
    else if (kind == Words::Kind::Line)
    {
      // The line is counted already. Coordinates may go on in the next one.
      if (reading.isWhole())
      {
        reading.finish(list, words.line() - 1);
      }
    }
    else
    {
      throw Problem(kind == Words::Kind::End ? "ends before the semicolon that ends its points"
                                             : "has \"" + shownWords(word) +
            "\" at a wrong place in line " + std::to_string(words.line()));
    }
  }
}

bool looksLikeTags(const std::string& beginning)
{
  return trimmed(beginning).compare(0, Magic.size(), Magic) == 0;
}

void readTags(const std::string& text, const LandmarkChoice& choice, LandmarkList& list)
{
  if (!looksLikeTags(text))
  {
    throw Problem("does not begin with \"" + std::string(Magic) + "\"");
  }
  Words words(std::string_view(text).substr(text.find(Magic) + Magic.size()));
  const std::size_t volumes = readHeader(words);
  if (static_cast<std::size_t>(choice.volume) > volumes)
  {
    throw Problem(
      "has points of 1 volume; Volume is " + std::to_string(choice.volume) + "; set Volume to 1");
  }

  Reading reading;
  reading.coordinates = 3 * volumes;
  reading.offset = choice.volume == 2 ? 3 : 0;
  readPoints(words, reading, list);
  if (volumes == 2 && choice.volume == 0)
  {
    list.notes.emplace_back("has the points of two volumes, of which those of the first are read; "
                            "set Volume to 1 or 2");
  }
}

// Those of one volume. Quotes in labels become apostrophes, new lines spaces.
void writeTags(std::ostream& file, FileAxes /*axes*/, LandmarkList& list)
{
  std::size_t changed = 0;
  file << Magic << "\nVolumes = 1;\n\nPoints =";
  for (const Landmark& point : list.points)
  {
    std::string label = validUtf8(point.label);
    changed += label.find_first_of("\"\r\n") != std::string::npos ? 1 : 0;
    std::replace(label.begin(), label.end(), '"', '\'');
    std::replace_if(label.begin(), label.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    file << "\n " << numberText(point.position.x) << " " << numberText(point.position.y) << " "
         << numberText(point.position.z) << " \"" << label << "\"";
  }
  file << ";\n";
  if (changed > 0)
  {
    list.notes.push_back("has " + std::to_string(changed) +
      " labels with quotes or new lines, which became apostrophes and spaces");
  }
}
}

extern const LandmarkFormat LandmarksOfTags{ []() -> std::vector<std::string> {
                                              return { ".tag" };
                                            },
  looksLikeTags, readTags, writeTags, FileAxes::RAS, /*hasOneFrame=*/true,
  /*isUtf8=*/false, /*holdsNumbers=*/false };
}

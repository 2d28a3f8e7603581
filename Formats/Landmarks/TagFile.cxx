// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Landmarks/TagFile.h"

#include "Common/Numbers.h"
#include "Formats/Files/Text.h"
#include "Formats/Landmarks/PlainText.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

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
std::string expect(Words& words, std::string_view wanted)
{
  std::string word;
  Words::Kind kind = Words::Kind::Line;
  while (kind == Words::Kind::Line)
  {
    kind = words.next(word);
  }
  return word == wanted && kind != Words::Kind::Quoted ? ""
                                                       : "has \"" + shownWords(word) +
      "\" in line " + std::to_string(words.line()) + "; it must have " + std::string(wanted);
}

std::string readHeader(Words& words, std::size_t& volumes)
{
  std::string problem = expect(words, "Volumes");
  problem = problem.empty() ? expect(words, "=") : problem;
  std::string count;
  if (problem.empty())
  {
    words.next(count);
    volumes = count == "1" ? 1 : 2;
    problem = count == "1" || count == "2"
      ? ""
      : "has points of " + shownWords(count) + " volumes; it must have 1 or 2";
  }
  problem = problem.empty() ? expect(words, ";") : problem;
  problem = problem.empty() ? expect(words, "Points") : problem;
  return problem.empty() ? expect(words, "=") : problem;
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
  std::string finish(LandmarkList& list, std::size_t line)
  {
    const std::string where = "line " + std::to_string(line);
    const std::size_t count = this->numbers.size();
    if (count == 0 && this->label.empty())
    {
      return {};
    }
    if (count != this->coordinates && count != this->coordinates + NumbersAfter)
    {
      return "has " + std::to_string(count) + " numbers for a point in " + where +
        "; it must have " + std::to_string(this->coordinates) + ", and 3 more or none";
    }
    Landmark point;
    point.number = static_cast<double>(list.points.size() + 1);
    point.position = { this->numbers[this->offset], this->numbers[this->offset + 1],
      this->numbers[this->offset + 2] };
    point.label = validUtf8(this->label);
    this->numbers.clear();
    this->label.clear();
    return addLandmark(list, point, where);
  }
};

std::string readPoints(Words& words, Reading& reading, LandmarkList& list)
{
  std::string word;
  while (true)
  {
    const Words::Kind kind = words.next(word);
    std::string problem;
    if (kind == Words::Kind::Mark && word == ";")
    {
      return reading.finish(list, words.line());
    }
    if (kind == Words::Kind::Word && reading.numbers.size() < reading.coordinates + NumbersAfter)
    {
      const std::optional<double> number = numberIn(word);
      reading.numbers.push_back(number.value_or(0.0));
      problem = std::isfinite(number.value_or(NAN))
        ? ""
        : "has \"" + shownWords(word) + "\" in place of a number";
    }
    else if (kind == Words::Kind::Quoted && reading.isWhole())
    {
      reading.label = word;
      problem = reading.finish(list, words.line());
    }
    else if (kind == Words::Kind::Line)
    {
      // The line is counted already. Coordinates may go on in the next one.
      problem = reading.isWhole() ? reading.finish(list, words.line() - 1) : std::string();
    }
    else
    {
      problem = kind == Words::Kind::End ? "ends before the semicolon that ends its points"
                                         : "has \"" + shownWords(word) +
          "\" at a wrong place in line " + std::to_string(words.line());
    }
    if (!problem.empty())
    {
      return problem;
    }
  }
}
}

std::string readTags(const std::string& text, int volume, LandmarkList& list)
{
  if (!looksLikeTags(text))
  {
    return "does not begin with \"" + std::string(Magic) + "\"";
  }
  Words words(std::string_view(text).substr(text.find(Magic) + Magic.size()));
  std::size_t volumes = 1;
  std::string problem = readHeader(words, volumes);
  if (problem.empty() && static_cast<std::size_t>(volume) > volumes)
  {
    problem = "has points of 1 volume; Volume is " + std::to_string(volume);
  }
  if (!problem.empty())
  {
    return problem;
  }
  Reading reading;
  reading.coordinates = 3 * volumes;
  reading.offset = 3 * static_cast<std::size_t>(volume - 1);
  return readPoints(words, reading, list);
}

bool looksLikeTags(const std::string& beginning)
{
  return trimmed(beginning).compare(0, Magic.size(), Magic) == 0;
}

bool isChangedInTags(const std::string& label)
{
  return label.find_first_of("\"\r\n") != std::string::npos;
}

void writeTags(std::ostream& file, const LandmarkList& list)
{
  file << Magic << "\nVolumes = 1;\n\nPoints =";
  for (const Landmark& point : list.points)
  {
    std::string label = validUtf8(point.label);
    std::replace(label.begin(), label.end(), '"', '\'');
    std::replace_if(label.begin(), label.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    file << "\n " << numberText(point.position.x) << " " << numberText(point.position.y) << " "
         << numberText(point.position.z) << " \"" << label << "\"";
  }
  file << ";\n";
}
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/TextHeaders/TextHeader.h"

#include "Common/Bytes.h"
#include "Common/Numbers.h"
#include "Formats/Files/PlainFile.h"
#include "Formats/Files/Text.h"
#include "Formats/Volumes/OutgoingVolume.h"

#include "vtkDataArray.h"
#include "vtkSetGet.h" // for vtkTemplateMacro

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <type_traits>

namespace brainshift
{
namespace
{
constexpr std::size_t LongestHeader = 1 << 20; // bytes; what is longer is no header

// The bytes of a file in which a header must end.
std::string readStart(const std::string& fileName)
{
  std::ifstream file(fileName, std::ios::binary);
  if (!file)
  {
    throw Problem("cannot be opened");
  }
  std::string start(LongestHeader, '\0');
  file.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(file.gcount()));
  return start;
}

// Whether the lines that follow are names of files.
bool announcesList(const HeaderText& text)
{
  const std::vector<std::string> words =
    wordsIn(text.valueOf({ "data file", "datafile", "ElementDataFile" }));
  return !words.empty() && words[0] == "LIST";
}

// Puts a line under its key. False if it is the last one of a header.
bool takeLine(const std::string& line, HeaderText& text)
{
  const bool isComment = line[0] == '#';
  if (isComment && text.isNRRD)
  {
    text.comments += line + "\n";
  }
  const std::size_t mark = line.find(text.isNRRD ? ':' : '=');
  if (mark == std::string::npos || isComment)
  {
    return true;
  }
  const bool isKey = line.compare(mark, 2, ":=") == 0;
  const std::string name = trimmed(line.substr(0, mark));
  const std::string value = trimmed(line.substr(isKey ? mark + 2 : mark + 1));
  if (!isKey)
  {
    text.names.push_back(name);
  }
  const auto [known, isNew] =
    isKey ? text.keys.emplace(name, value) : text.fields.emplace(lowerCase(name), value);
  if (!isNew && !(isKey && known->second == value))
  {
    text.repeated.push_back(name);
  }
  return text.isNRRD || !text.has("ElementDataFile");
}

// False if the text ends before the header does.
bool splitLines(const std::string& start, HeaderText& text)
{
  bool lists = false;
  for (std::size_t begin = 0; begin < start.size(); begin = text.bytes)
  {
    const std::size_t newLine = start.find('\n', begin);
    if (newLine == std::string::npos && start.size() == LongestHeader)
    {
      return false;
    }
    const std::string line = start.substr(begin, newLine - begin);
    text.bytes = newLine == std::string::npos ? start.size() : newLine + 1;
    if (lists)
    {
      const std::string name = trimmed(line);
      if (!name.empty() && name[0] != '#')
      {
        text.listed.push_back(name);
      }
      continue;
    }
    if (text.isNRRD && trimmed(line).empty())
    {
      return true; // the numbers follow
    }
    const bool isLast = !takeLine(line, text);
    lists = announcesList(text);
    if (isLast && !lists)
    {
      return true;
    }
  }
  return start.size() < LongestHeader;
}

void requireLetters(const std::string& header)
{
  const auto isControl = [](char c) {
    return (c >= 0 && c < ' ' && c != '\t' && c != '\r' && c != '\n') || c == '\x7f';
  };
  const auto found = std::find_if(header.begin(), header.end(), isControl);
  if (found != header.end())
  {
    throw Problem("has a header with the control character " +
      std::to_string(static_cast<int>(*found)) + "; a header must be text");
  }
}

constexpr double MostFiles = 65536.0;

std::string beside(const std::string& fileName, const std::string& name)
{
  return (std::filesystem::path(fileName).parent_path() / name).string();
}

// The number in the place of %d, %3d or %03d.
std::string numbered(const std::string& pattern, long long number)
{
  const std::size_t begin = pattern.find('%');
  const std::size_t end = pattern.find('d', begin);
  const std::string width = pattern.substr(begin + 1, end - begin - 1);
  std::string digits = std::to_string(number);
  const std::size_t wanted = width.empty() ? 0 : std::stoul(width);
  const char filler = !width.empty() && width[0] == '0' ? '0' : ' ';
  digits.insert(0, wanted > digits.size() ? wanted - digits.size() : 0, filler);
  return pattern.substr(0, begin) + digits + pattern.substr(end + 1);
}

// Whether a name has one %d, %3d or %03d, of at most two digits.
bool isPattern(const std::string& name)
{
  const std::size_t begin = name.find('%');
  const std::size_t end = begin == std::string::npos ? begin : name.find('d', begin);
  return end != std::string::npos && end - begin <= 3 && name.find('%', end) == std::string::npos &&
    std::all_of(name.begin() + static_cast<std::ptrdiff_t>(begin) + 1,
      name.begin() + static_cast<std::ptrdiff_t>(end), [](char c) { return c >= '0' && c <= '9'; });
}

void namePattern(
  const std::string& fileName, const std::vector<std::string>& words, TextHeader& header)
{
  std::vector<double> range;
  for (std::size_t i = 1; i < words.size(); ++i)
  {
    const std::vector<double> number = numbersIn(words[i]);
    range.push_back(number.size() == 1 ? number[0] : std::nan(""));
  }
  range.resize(std::max<std::size_t>(range.size(), 2), std::nan(""));
  const double step = range.size() > 2 ? range[2] : 1.0;
  constexpr double Most = 1e9;
  if (!isWhole(range[0], 0.0, Most) || !isWhole(range[1], 0.0, Most) ||
    !isWhole(std::abs(step), 1.0, Most) || !((range[1] - range[0]) / step >= 0.0))
  {
    throw Problem(
      "numbers its data files from, to and by something other than whole numbers: " + words[0]);
  }
  const double count = std::floor((range[1] - range[0]) / step) + 1.0;
  if (count > MostFiles)
  {
    throw Problem(
      "names " + std::to_string(static_cast<long long>(count)) + " data files; it may name 65536");
  }
  for (double i = 0.0; i < count; i += 1.0)
  {
    header.dataFiles.push_back(
      beside(fileName, numbered(words[0], static_cast<long long>(range[0] + i * step))));
  }
}

// Runs a step on a data file. An error says where it is, if the header names another file.
template <typename Step>
void onDataFile(const TextHeader& header, const std::string& dataFile, const Step& step)
{
  withBeginning(
    header.isLocal ? std::string() : "names the file " + shownWords(dataFile) + ", which ", step);
}

// The byte after some lines of a file.
std::uint64_t afterLines(const std::string& fileName, std::uint64_t lines, std::uint64_t offset)
{
  if (lines == 0)
  {
    return offset;
  }
  std::ifstream file(fileName, std::ios::binary);
  file.seekg(static_cast<std::streamoff>(offset));
  for (std::uint64_t i = 0; i < lines; ++i)
  {
    file.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
    if (!file)
    {
      throw Problem("has fewer lines than the header skips, " + std::to_string(lines));
    }
  }
  return static_cast<std::uint64_t>(file.tellg());
}

// Where the numbers of one file of a header are.
StoredBytes locate(const TextHeader& header, const std::string& dataFile)
{
  requirePlainFile(dataFile);
  StoredBytes from;
  from.fileName = dataFile;
  from.isPacked = header.encoding == Encoding::Packed;
  from.unpackedSkip = header.unpackedSkip;
  from.offset = header.isLocal ? header.text.bytes : 0;
  const double count = header.dataBytes() / static_cast<double>(header.dataFiles.size());
  if (header.isAtEnd)
  {
    std::error_code error;
    const auto size = static_cast<double>(std::filesystem::file_size(dataFile, error));
    const double begin = std::max(size - count, static_cast<double>(from.offset));
    from.offset = error ? from.offset : static_cast<std::uint64_t>(begin);
    return from;
  }
  from.offset = afterLines(dataFile, header.lineSkip, from.offset) + header.fileSkip;
  return from;
}

// Reads decimal numbers between spaces and commas.
template <typename T>
void readWords(std::ifstream& file, T* to, std::size_t count, const FractionDone& fractionDone)
{
  using Stored = std::conditional_t<std::is_floating_point_v<T>, double, T>;
  constexpr std::size_t Often = 1 << 16;
  constexpr std::size_t LongestWord = 64;
  std::string word;
  for (std::size_t i = 0; i < count; ++i)
  {
    int letter = file.get();
    const auto isBetween = [&] { return letter == ',' || (letter >= 0 && letter <= ' '); };
    while (isBetween())
    {
      letter = file.get();
    }
    word.clear();
    for (; letter >= 0 && !isBetween() && word.size() <= LongestWord; letter = file.get())
    {
      word += static_cast<char>(letter);
    }
    const auto number = numberIn<Stored>(word);
    if (!number)
    {
      throw Problem(word.empty()
          ? "has " + std::to_string(i) + " numbers as text where the header announces " +
            std::to_string(count)
          : "has '" + shownWords(word) + "' where a number of its type must stand");
    }
    to[i] = static_cast<T>(*number);
    if (i % Often == 0 && !fractionDone(static_cast<double>(i) / static_cast<double>(count)))
    {
      return;
    }
  }
}

void readText(
  const StoredBytes& from, int type, char* to, std::size_t count, const FractionDone& fractionDone)
{
  std::ifstream file(from.fileName, std::ios::binary);
  file.seekg(static_cast<std::streamoff>(from.offset));
  switch (type)
  {
    vtkTemplateMacro(readWords(file, reinterpret_cast<VTK_TT*>(to), count, fractionDone));
  }
}

// A number as text takes two bytes at least, the last one takes one.
double leastBytes(const TextHeader& header)
{
  const double bytes =
    header.encoding == Encoding::Text ? 2.0 * header.numberCount() : header.dataBytes();
  const double each = bytes / static_cast<double>(header.dataFiles.size());
  return header.encoding == Encoding::Text ? each - 1.0 : each;
}
}

std::string HeaderText::valueOf(const std::vector<std::string>& names) const
{
  for (const std::string& name : names)
  {
    const auto line = this->fields.find(lowerCase(name));
    if (line != this->fields.end())
    {
      return line->second;
    }
  }
  return {};
}

bool HeaderText::has(const std::string& name) const
{
  return this->fields.count(lowerCase(name)) > 0;
}

std::string HeaderText::keyed(const std::string& name) const
{
  const auto line = this->keys.find(name);
  return line == this->keys.end() ? std::string() : line->second;
}

void readHeaderText(const std::string& fileName, HeaderText& text)
{
  text = HeaderText();
  requirePlainFile(fileName);
  const std::string start = withLineFeeds(readStart(fileName));
  text.isNRRD = start.compare(0, 4, "NRRD") == 0;
  if (!splitLines(start, text))
  {
    throw Problem(
      "has no end of a header in its first " + std::to_string(LongestHeader) + " bytes");
  }
  requireLetters(start.substr(0, text.bytes));
}

double TextHeader::numberCount() const
{
  double count = 1.0;
  for (const HeaderAxis& axis : this->axes)
  {
    count *= static_cast<double>(axis.count);
  }
  return count;
}

double TextHeader::dataBytes() const
{
  return this->numberCount() * vtkDataArray::GetDataTypeSize(this->numberType);
}

int TextHeader::spatialAxes() const
{
  return static_cast<int>(std::count_if(this->axes.begin(), this->axes.end(),
    [](const HeaderAxis& axis) { return axis.step.has_value(); }));
}

bool TextHeader::saysSides() const
{
  const std::string note =
    this->text.isNRRD ? this->text.comments : this->text.valueOf({ "Comment" });
  return this->knowsSides && note.find(UnknownSidesNote) == std::string::npos;
}

void nameDataFiles(const std::string& fileName, const std::string& words, TextHeader& header)
{
  header.dataFiles.clear();
  const std::vector<std::string> parts = wordsIn(words);
  if (parts.empty() || (parts.size() == 1 && lowerCase(parts[0]) == "local"))
  {
    header.dataFiles.push_back(fileName);
    header.isLocal = true;
    return;
  }
  if (parts[0] == "LIST")
  {
    for (const std::string& name : header.text.listed)
    {
      header.dataFiles.push_back(beside(fileName, name));
    }
    if (header.dataFiles.empty() || static_cast<double>(header.dataFiles.size()) > MostFiles)
    {
      throw Problem(
        "lists " + std::to_string(header.dataFiles.size()) + " data files; it may list 1 to 65536");
    }
    return;
  }
  if (parts.size() > 2 && isPattern(parts[0]))
  {
    namePattern(fileName, parts, header);
    return;
  }
  header.dataFiles.push_back(beside(fileName, words));
}

void readTextHeader(const std::string& fileName, TextHeader& header)
{
  header = TextHeader();
  const std::string problem = problemOf([&] {
    readHeaderText(fileName, header.text);
    if (header.text.isNRRD)
    {
      fromNRRD(fileName, header);
    }
    else
    {
      fromMetaImage(fileName, header);
    }
  });
  throwIfAny(shownWords(problem));
}

namespace
{
// Bytes that a file has beside those that its header announces, unpacked; 0 if that is not known.
double surplusOf(const TextHeader& header, const std::string& dataFile)
{
  constexpr double Modulus = 4294967296.0; // gzip ends with the number of its bytes, modulo this
  std::error_code error;
  const auto size = static_cast<double>(std::filesystem::file_size(dataFile, error));
  const double wanted = header.dataBytes() / static_cast<double>(header.dataFiles.size());
  if (error || header.isAtEnd || header.encoding == Encoding::Text || header.lineSkip > 0)
  {
    return 0.0;
  }
  if (header.encoding == Encoding::Raw)
  {
    return std::max(0.0, size - static_cast<double>(header.fileSkip) - wanted);
  }
  std::ifstream file(dataFile, std::ios::binary);
  std::array<unsigned char, 4> last{};
  std::array<unsigned char, 2> first{};
  file.read(reinterpret_cast<char*>(first.data()), first.size());
  file.seekg(-static_cast<std::streamoff>(last.size()), std::ios::end);
  file.read(reinterpret_cast<char*>(last.data()), last.size());
  const bool isGzip = file && first[0] == 0x1f && first[1] == 0x8b;
  const double unpacked = last[0] + 256.0 * (last[1] + 256.0 * (last[2] + 256.0 * last[3]));
  const double all = wanted + static_cast<double>(header.unpackedSkip);
  return isGzip && all < Modulus ? std::max(0.0, unpacked - all) : 0.0;
}
}

void warnOfSurplus(TextHeader& header)
{
  for (const std::string& dataFile : header.dataFiles)
  {
    const double surplus = header.isLocal ? 0.0 : surplusOf(header, dataFile);
    if (surplus > 0.0)
    {
      header.warnings.push_back(joined("leaves out ", surplus, " bytes at the end of ",
        shownWords(std::filesystem::path(dataFile).filename().string()),
        "; if that file begins with a header of its own, the voxels are at wrong places: ",
        header.text.isNRRD ? "byte skip" : "HeaderSize", " must leave it out"));
      return;
    }
  }
}

void requireNumbers(const TextHeader& header)
{
  const auto files = static_cast<double>(header.dataFiles.size());
  if (std::fmod(header.numberCount(), files) != 0.0)
  {
    throw Problem("spreads its numbers over " + std::to_string(header.dataFiles.size()) +
      " files, which cannot have equal parts");
  }
  for (const std::string& dataFile : header.dataFiles)
  {
    onDataFile(
      header, dataFile, [&] { requireBytes(locate(header, dataFile), leastBytes(header)); });
  }
}

void readNumbers(const TextHeader& header, char* to, const FractionDone& fractionDone)
{
  const std::size_t files = header.dataFiles.size();
  const auto bytes = static_cast<std::size_t>(header.dataBytes()) / files;
  const auto size = static_cast<std::size_t>(vtkDataArray::GetDataTypeSize(header.numberType));
  bool stopped = false;
  for (std::size_t i = 0; i < files && !stopped; ++i)
  {
    const FractionDone fraction = [&](double of) {
      stopped = !fractionDone((static_cast<double>(i) + of) / static_cast<double>(files));
      return !stopped;
    };
    char* const part = to + i * bytes;
    onDataFile(header, header.dataFiles[i], [&] {
      const StoredBytes from = locate(header, header.dataFiles[i]);
      if (header.encoding == Encoding::Text)
      {
        readText(from, header.numberType, part, bytes / size, fraction);
      }
      else
      {
        readBytes(from, part, bytes, fraction);
      }
    });
  }
  if (header.encoding != Encoding::Text)
  {
    toMachineOrder(to, files * bytes / size, size, header.isBigEndian);
  }
}

bool hasNumbersInOneFile(const TextHeader& header)
{
  return header.encoding != Encoding::Text && header.dataFiles.size() == 1;
}

void readNumbers(const TextHeader& header, std::uint64_t skip, const StoredBox& box, char* to,
  const FractionDone& fractionDone)
{
  const std::string& dataFile = header.dataFiles.front();
  onDataFile(header, dataFile, [&] {
    StoredBytes from = locate(header, dataFile);
    (from.isPacked ? from.unpackedSkip : from.offset) += skip;
    readBox(from, box, to, fractionDone);
  });
  const auto size = static_cast<std::size_t>(vtkDataArray::GetDataTypeSize(header.numberType));
  toMachineOrder(to, box.voxelCount() * box.bytes / size, size, header.isBigEndian);
}
}

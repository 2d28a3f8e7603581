// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/TextHeaders/TextHeaderFile.h"

#include "Common/Bytes.h"
#include "Common/Numbers.h"
#include "Formats/Files/PlainFile.h"
#include "Formats/Files/Text.h"
#include "Formats/TextHeaders/MetaImageHeader.h"
#include "Formats/TextHeaders/NRRDHeader.h"

#include "vtkDataArray.h"
#include "vtkSetGet.h" // for vtkTemplateMacro

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <type_traits>

namespace brainshift
{
namespace
{
// The file where an error is, if the header names another one.
std::string named(const TextHeader& header, const std::string& dataFile, const std::string& problem)
{
  return problem.empty() || header.isLocal
    ? problem
    : "names the file " + shownWords(dataFile) + ", which " + problem;
}

// The byte after some lines of a file.
std::string afterLines(const std::string& fileName, std::uint64_t lines, std::uint64_t& offset)
{
  if (lines == 0)
  {
    return {};
  }
  std::ifstream file(fileName, std::ios::binary);
  file.seekg(static_cast<std::streamoff>(offset));
  for (std::uint64_t i = 0; i < lines; ++i)
  {
    file.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
    if (!file)
    {
      return "has fewer lines than the header skips, " + std::to_string(lines);
    }
  }
  offset = static_cast<std::uint64_t>(file.tellg());
  return {};
}

// Where the numbers of one file of a header are.
std::string locate(const TextHeader& header, const std::string& dataFile, StoredBytes& from)
{
  const std::string notPlain = plainFileProblem(dataFile);
  if (!notPlain.empty())
  {
    return notPlain;
  }
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
    return {};
  }
  const std::string problem = afterLines(dataFile, header.lineSkip, from.offset);
  from.offset += header.fileSkip;
  return problem;
}

// Reads decimal numbers between spaces and commas.
template <typename T>
std::string readWords(std::ifstream& file, T* to, std::size_t count, const ShareDone& shareDone)
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
      return word.empty() ? "has " + std::to_string(i) +
          " numbers as text where the header announces " + std::to_string(count)
                          : "has '" + shownWords(word) + "' where a number of its type must stand";
    }
    to[i] = static_cast<T>(*number);
    if (i % Often == 0 && !shareDone(static_cast<double>(i) / static_cast<double>(count)))
    {
      return {};
    }
  }
  return {};
}

std::string readText(
  const StoredBytes& from, int type, char* to, std::size_t count, const ShareDone& shareDone)
{
  std::ifstream file(from.fileName, std::ios::binary);
  file.seekg(static_cast<std::streamoff>(from.offset));
  switch (type)
  {
    vtkTemplateMacro(return readWords(file, reinterpret_cast<VTK_TT*>(to), count, shareDone));
    default:
      return {};
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

std::string readTextHeader(const std::string& fileName, TextHeader& header)
{
  header = TextHeader();
  std::string problem = readHeaderText(fileName, header.text);
  if (problem.empty())
  {
    problem = header.text.isNRRD ? fromNRRD(fileName, header) : fromMetaImage(fileName, header);
  }
  return shownWords(problem);
}

std::string numbersProblem(const TextHeader& header)
{
  const auto files = static_cast<double>(header.dataFiles.size());
  if (std::fmod(header.numberCount(), files) != 0.0)
  {
    return "spreads its numbers over " + std::to_string(header.dataFiles.size()) +
      " files, which cannot have equal parts";
  }
  for (const std::string& dataFile : header.dataFiles)
  {
    StoredBytes from;
    std::string problem = locate(header, dataFile, from);
    problem = problem.empty() ? bytesProblem(from, leastBytes(header)) : problem;
    if (!problem.empty())
    {
      return named(header, dataFile, problem);
    }
  }
  return {};
}

std::string readNumbers(const TextHeader& header, char* to, const ShareDone& shareDone)
{
  const std::size_t files = header.dataFiles.size();
  const auto bytes = static_cast<std::size_t>(header.dataBytes()) / files;
  const auto size = static_cast<std::size_t>(vtkDataArray::GetDataTypeSize(header.numberType));
  bool stopped = false;
  for (std::size_t i = 0; i < files && !stopped; ++i)
  {
    const ShareDone share = [&](double of) {
      stopped = !shareDone((static_cast<double>(i) + of) / static_cast<double>(files));
      return !stopped;
    };
    char* const part = to + i * bytes;
    StoredBytes from;
    std::string problem = locate(header, header.dataFiles[i], from);
    if (problem.empty())
    {
      problem = header.encoding == Encoding::Text
        ? readText(from, header.numberType, part, bytes / size, share)
        : readBytes(from, part, bytes, share);
    }
    if (!problem.empty())
    {
      return named(header, header.dataFiles[i], problem);
    }
  }
  if (header.encoding != Encoding::Text)
  {
    toMachineOrder(to, files * bytes / size, size, header.isBigEndian);
  }
  return {};
}
}

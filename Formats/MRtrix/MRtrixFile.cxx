// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Streamlines of MRtrix (.tck): points in the scanner's RAS, mm.
///
/// A header of lines "key: value" ends with "END". Three numbers for each point follow; three NaN
/// end a streamline, and three infinite numbers end the file.
#include "Common/Bytes.h"
#include "Common/Numbers.h"
#include "Formats/Files/PackedBytes.h"
#include "Formats/Files/Text.h"
#include "Formats/Files/WholeFile.h"
#include "Formats/Surfaces/SurfaceFile.h"

#include <cmath>
#include <limits>

namespace brainshift
{
namespace
{
constexpr std::string_view Magic = "mrtrix tracks";
constexpr std::size_t LongestHeader = 1 << 20; // bytes

// What the lines of the header say of the numbers.
struct TrackText
{
  std::size_t offset = 0; // of the first number
  std::size_t size = 4;   // bytes of a number
  bool isBigEndian = false;
  double count = 0.0; // of streamlines; 0: not given
};

// The keys up to END. False if it does not come.
bool readKeys(std::string_view text, std::map<std::string, std::string>& keys)
{
  for (std::size_t place = 0; place < text.size();)
  {
    const std::size_t end = std::min(text.find('\n', place), text.size());
    const std::string_view line = text.substr(place, end - place);
    if (trimmed(line) == "END")
    {
      return end < text.size();
    }
    const std::size_t colon = line.find(':');
    if (colon != std::string_view::npos)
    {
      const std::string name = trimmed(line.substr(0, colon));
      const std::string value = trimmed(line.substr(colon + 1));
      const bool isSame = keys.emplace(name, value).first->second == value;
      const bool counts = name == "file" || name == "datatype" || name == "count";
      throwIfAny(counts && !isSame ? twice("line \"" + name + ":\"") : "");
    }
    place = end + 1;
  }
  return false;
}

TrackText readHeader(const std::vector<char>& bytes)
{
  TrackText header;
  const std::string_view text(bytes.data(), std::min(bytes.size(), LongestHeader));
  std::map<std::string, std::string> keys;
  if (text.substr(0, Magic.size()) != Magic || !readKeys(text, keys))
  {
    throw Problem(text.substr(0, Magic.size()) != Magic
        ? "begins neither with TRACK, as TrackVis does, "
          "nor with \"mrtrix tracks\""
        : "has no line END within its first 1048576 bytes");
  }
  const std::vector<std::string> where = wordsIn(keys["file"]);
  const std::vector<double> offset = where.size() == 2 ? numbersIn(where[1]) : numbersIn("");
  if (offset.size() != 1 || where[0] != "." ||
    !isWhole(offset[0], static_cast<double>(Magic.size()), static_cast<double>(bytes.size())))
  {
    throw Problem("has the line \"file: " + shownWords(keys["file"]) +
      "\"; it must be a point and the place of the first number, up to " +
      std::to_string(bytes.size()));
  }
  header.offset = static_cast<std::size_t>(offset[0]);
  const std::string type = keys["datatype"];
  header.size = type.rfind("Float64", 0) == 0 ? 8 : 4;
  header.isBigEndian = type == "Float32BE" || type == "Float64BE";
  if (!header.isBigEndian && type != "Float32LE" && type != "Float64LE")
  {
    throw Problem("has the datatype " + shownWords(type) +
      "; it must be Float32LE, Float32BE, Float64LE or Float64BE");
  }
  const std::vector<double> count = numbersIn(keys["count"]);
  header.count = count.size() == 1 && isWhole(count[0], 0, 1e15) ? count[0] : 0.0;
  return header;
}

// Points of a file, whose numbers are in the order of this machine.
template <typename T>
class Triples
{
public:
  Triples(const std::vector<char>& bytes, std::size_t offset)
    : First(bytes.data() + offset)
    , Count((bytes.size() - offset) / (3 * sizeof(T)))
  {
  }

  std::size_t count() const { return this->Count; }

  std::array<T, 3> at(std::size_t index) const
  {
    std::array<T, 3> triple;
    std::memcpy(triple.data(), this->First + index * sizeof(triple), sizeof(triple));
    return triple;
  }

private:
  const char* First;
  std::size_t Count;
};

template <typename T>
bool isAll(const std::array<T, 3>& triple, bool (*holds)(T))
{
  return holds(triple[0]) && holds(triple[1]) && holds(triple[2]);
}

// Ends a streamline, if it has points.
void endStreamline(Tracts& tracts, std::size_t& empty)
{
  const auto points = static_cast<std::int64_t>(tracts.points.size());
  if (points > tracts.firsts.back())
  {
    tracts.firsts.push_back(points);
  }
  else
  {
    ++empty;
  }
}

// Takes triples up to those that end the file. False if it was stopped.
template <typename T>
bool takeTriples(
  const Triples<T>& triples, const FractionDone& fractionDone, Tracts& tracts, std::size_t& empty)
{
  constexpr std::size_t Block = 1 << 18; // triples between two reports of progress
  const auto limit = static_cast<T>(FarthestPoint);
  tracts.points.reserve(triples.count());
  for (std::size_t i = 0; i < triples.count(); ++i)
  {
    const std::array<T, 3> triple = triples.at(i);
    if (std::abs(triple[0]) <= limit && std::abs(triple[1]) <= limit &&
      std::abs(triple[2]) <= limit)
    {
      tracts.points.emplace_back(triple[0], triple[1], triple[2]);
    }
    else if (isAll<T>(triple, [](T number) { return std::isnan(number); }))
    {
      endStreamline(tracts, empty);
    }
    else if (isAll<T>(triple, [](T number) { return std::isinf(number); }))
    {
      return true;
    }
    else
    {
      requirePoint(glm::dvec3(triple[0], triple[1], triple[2]),
        "point " + std::to_string(tracts.points.size()));
    }
    if (i % Block == 0 &&
      !fractionDone(static_cast<double>(i) / static_cast<double>(triples.count())))
    {
      tracts = Tracts();
      return false;
    }
  }
  throw Problem("ends before the three infinite numbers that end such a file");
}

template <typename T>
void readTriples(std::vector<char>& bytes, const TrackText& header,
  const FractionDone& fractionDone, Tracts& tracts)
{
  toMachineOrder(bytes.data() + header.offset, (bytes.size() - header.offset) / sizeof(T),
    sizeof(T), header.isBigEndian);
  std::size_t empty = 0;
  if (!takeTriples<T>(Triples<T>(bytes, header.offset), fractionDone, tracts, empty))
  {
    return;
  }
  if (static_cast<std::int64_t>(tracts.points.size()) > tracts.firsts.back())
  {
    tracts.firsts.push_back(static_cast<std::int64_t>(tracts.points.size()));
  }
  if (empty > 0)
  {
    tracts.notes.push_back("has " + counted(empty, "streamline") + " without points; left out");
  }
  const std::size_t found = tracts.firsts.size() - 1 + empty;
  if (header.count > 0.0 && header.count != static_cast<double>(found))
  {
    tracts.notes.push_back("announces " +
      counted(static_cast<std::size_t>(header.count), "streamline") + " and has " +
      std::to_string(found));
  }
}

bool isMRtrixFile(const std::string& fileName)
{
  return readUnpackedBeginning(fileName, Magic.size()) == Magic;
}

void readMRtrix(
  std::vector<char>& bytes, const TractSource&, const FractionDone& fractionDone, Tracts& tracts)
{
  const TrackText header = readHeader(bytes);
  if (header.size == 8)
  {
    readTriples<double>(bytes, header, fractionDone, tracts);
  }
  else
  {
    readTriples<float>(bytes, header, fractionDone, tracts);
  }
}

// Such files hold points only.
void writeMRtrix(
  const std::string& fileName, const Tracts& tracts, const TractBox&, TractNotes& notes)
{
  std::string names;
  for (const auto* list : { &tracts.ofPoints, &tracts.ofStreamlines })
  {
    for (const NamedNumbers& numbers : *list)
    {
      names += (names.empty() ? "" : ", ") + numbers.name;
    }
  }
  if (!names.empty())
  {
    notes.push_back("holds points only, and leaves out " + names + "; .trx keeps them");
  }
  const std::string beginning = std::string(Magic) + "\ndatatype: Float32" +
    (thisMachineIsBigEndian() ? "BE" : "LE") +
    "\ncount: " + std::to_string(tracts.firsts.size() - 1) + "\nfile: . ";
  constexpr std::size_t Offset = 128; // of the first number
  std::string header = beginning + std::to_string(Offset) + "\nEND\n";
  header.resize(Offset, '\n');
  const auto write = [](std::ostream& file, const glm::vec3& triple) {
    file.write(reinterpret_cast<const char*>(&triple), sizeof(triple));
  };
  writeWholeStream(fileName, [&](std::ostream& file) {
    file << header;
    for (std::size_t line = 0; line + 1 < tracts.firsts.size(); ++line)
    {
      for (std::int64_t point = tracts.firsts[line]; point < tracts.firsts[line + 1]; ++point)
      {
        write(file, tracts.points[static_cast<std::size_t>(point)]);
      }
      write(file, glm::vec3(std::numeric_limits<float>::quiet_NaN()));
    }
    write(file, glm::vec3(std::numeric_limits<float>::infinity()));
  });
}
}

extern const TractFormat TractsOfMRtrix{ isMRtrixFile, readMRtrix, ".tck", writeMRtrix };
}

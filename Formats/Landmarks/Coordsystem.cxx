// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Landmarks/Coordsystem.h"

#include "Formats/Files/PlainFile.h"
#include "Formats/Files/Text.h"
#include "Formats/Landmarks/CoordinateWords.h"

#include "vtk_nlohmannjson.h"
#include VTK_NLOHMANN_JSON(json.hpp)

#include <algorithm>
#include <filesystem>
#include <set>
#include <string_view>

namespace brainshift
{
namespace
{
namespace fs = std::filesystem;

constexpr std::size_t LongestSidecar = 16 << 20; // bytes
constexpr const char* Ending = "_coordsystem.json";

// The entities of a name, such as sub-01, without its last part.
std::set<std::string> entitiesOf(const std::string& name)
{
  std::set<std::string> entities;
  std::size_t at = 0;
  for (std::size_t end = name.find('_'); end != std::string::npos; end = name.find('_', at))
  {
    entities.insert(name.substr(at, end - at));
    at = end + 1;
  }
  return entities;
}

// The space that a name has, such as CTF in sub-01_space-CTF_electrodes.tsv; empty: none.
std::string spaceOf(const fs::path& table)
{
  constexpr std::string_view Key = "space-";
  for (const std::string& entity : entitiesOf(table.filename().string()))
  {
    if (entity.compare(0, Key.size(), Key) == 0)
    {
      return entity.substr(Key.size());
    }
  }
  return {};
}

// The file in a folder that is about a table: of those whose entities are all the table's, the one
// with the most.
std::string fileIn(const fs::path& folder, const fs::path& table)
{
  const std::set<std::string> own = entitiesOf(table.filename().string());
  std::string best;
  std::size_t most = 0;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
  {
    const std::string name = entry.path().filename().string();
    const std::set<std::string> entities = entitiesOf(name);
    const bool isAbout = endsWith(name, Ending) &&
      std::includes(own.begin(), own.end(), entities.begin(), entities.end());
    if (isAbout && entities.size() > most)
    {
      best = entry.path().string();
      most = entities.size();
    }
  }
  return best;
}

// The file that is about a table, beside it or, in a data set of BIDS, in a folder above it.
std::string fileAbout(const fs::path& table)
{
  constexpr int MostAbove = 4; // the data set, subject, session and kind of data
  std::error_code error;
  fs::path folder = fs::absolute(table, error).parent_path();
  std::string found = fileIn(folder, table);
  fs::path root = folder;
  for (int i = 0; i < MostAbove && !fs::exists(root / "dataset_description.json", error); ++i)
  {
    root = root.parent_path();
  }
  const bool isOfBIDS = fs::exists(root / "dataset_description.json", error);
  while (found.empty() && isOfBIDS && folder != root)
  {
    folder = folder.parent_path();
    found = fileIn(folder, table);
  }
  return found;
}

// The name of a file that is about other positions than those of a table. Empty: there is none.
std::string otherBeside(const fs::path& table)
{
  std::error_code error;
  const fs::path folder = table.has_parent_path() ? table.parent_path() : fs::path(".");
  std::string first;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
  {
    const std::string name = entry.path().filename().string();
    first = endsWith(name, Ending) && (first.empty() || name < first) ? name : first;
  }
  return first;
}

std::string wordIn(const nlohmann::json& object, const std::string& end, bool isOptodes)
{
  const std::vector<std::string> kinds = isOptodes
    ? std::vector<std::string>{ "NIRS" }
    : std::vector<std::string>{ "iEEG", "EEG", "MEG", "EMG" };
  for (const std::string& kind : kinds)
  {
    const auto found = object.find(kind + end);
    if (found != object.end() && found->is_string())
    {
      return found->get<std::string>();
    }
  }
  return {};
}

double unitIn(const nlohmann::json& object, bool isOptodes)
{
  const std::string unit = wordIn(object, "CoordinateUnits", isOptodes);
  if (lowerCase(unit) == "pixels")
  {
    throw Problem("says that the positions are pixels; they must be lengths");
  }
  constexpr std::pair<const char*, double> Units[] = { { "mm", 1.0 }, { "cm", 10.0 },
    { "m", 1000.0 }, { "um", 1e-3 }, { "\xc2\xb5m", 1e-3 }, { "\xce\xbcm", 1e-3 } };
  for (const auto& [name, mm] : Units)
  {
    if (unit == name)
    {
      return mm;
    }
  }
  throw Problem(unit.empty() ? "does not say CoordinateUnits; they must be mm, cm or m"
                             : "says the unit " + shownWords(unit) + "; it must be mm, cm or m");
}

// Whether a word names a frame whose axes are known.
bool isKnownFrame(const std::string& words)
{
  bool isKnown = true; // also one that is refused, such as CTF
  problemOf([&] { isKnown = frameIn(words).axes.has_value(); });
  return isKnown;
}

// BIDS names a system by the same word in both places.
void noteOtherSpace(const std::string& space, const std::string& system, LandmarkList& list)
{
  if (keyOf(space) != keyOf(system) && isKnownFrame(space) && isKnownFrame(system))
  {
    noteOnce(list,
      "is in the space " + shownWords(space) + " by its name, and in " + shownWords(system) +
        " by its coordsystem.json, which counts. Correct the one that is wrong");
  }
}

// The axes, with a note about a system that is not the scanner's.
std::optional<FileAxes> axesIn(const nlohmann::json& object, bool isOptodes, LandmarkList& list)
{
  const std::string system = wordIn(object, "CoordinateSystem", isOptodes);
  if (system.empty())
  {
    list.notes.emplace_back("has a coordsystem.json that does not say CoordinateSystem; check the "
                            "axes and the origin");
    return std::nullopt;
  }
  const FrameMeaning frame = frameIn(system);
  const std::string about = wordIn(object, "CoordinateSystemDescription", isOptodes);
  const bool isOpen = !frame.axes && !about.empty();
  noteDoubt(isOpen ? system + " (" + about + ")" : system, frame, list);
  return frame.axes;
}
}

std::optional<ElectrodeFrame> electrodeFrame(const std::string& tableName, LandmarkList& list)
{
  const bool isOptodes = endsWith(tableName, "_optodes.tsv");
  if (!isOptodes && !endsWith(tableName, "_electrodes.tsv"))
  {
    return std::nullopt;
  }
  const std::string beside = fileAbout(tableName);
  if (beside.empty())
  {
    const std::string other = otherBeside(tableName);
    list.notes.push_back(other.empty()
        ? "has no coordsystem.json beside it; the unit counts as mm unless the table names it"
        : "has no coordsystem.json of its own: " + shownWords(other) +
          " is about other positions; the unit counts as mm unless the table names it");
    const std::string space = spaceOf(tableName);
    if (!space.empty())
    {
      noteDoubt(space, frameIn(space), list);
    }
    return ElectrodeFrame();
  }
  ElectrodeFrame electrodes;
  withBeginning("needs " + beside + ", which ", [&] {
    std::set<std::string> keys; // of the object itself
    const auto requireOnce = [&keys](int depth, nlohmann::json::parse_event_t event,
                               const nlohmann::json& parsed) {
      const bool isKey = depth == 1 && event == nlohmann::json::parse_event_t::key;
      throwIfAny(isKey && !keys.insert(parsed.get<std::string>()).second
          ? twice("key " + shownWords(parsed.get<std::string>()))
          : "");
      return true;
    };
    const nlohmann::json object =
      nlohmann::json::parse(readPlainText(beside, LongestSidecar), requireOnce, /*throws*/ false);
    throwIfAny(object.is_object() ? "" : "is not good JSON");
    noteOtherSpace(spaceOf(tableName), wordIn(object, "CoordinateSystem", isOptodes), list);
    electrodes.axes = axesIn(object, isOptodes, list);
    electrodes.mm = unitIn(object, isOptodes);
    electrodes.isSaid = true;
  });
  return electrodes;
}
}

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Landmarks and traced points as files keep them, the limits that files must hold, and the
/// interface of a format. It takes text and gives points in RAS mm.
#ifndef BrainShift_LandmarkFormats_h
#define BrainShift_LandmarkFormats_h

#include <glm/glm.hpp>

#include <cstddef>
#include <limits>
#include <ostream>
#include <string>
#include <vector>

namespace brainshift
{
/** The most points that a file may hold. */
constexpr std::size_t MostLandmarks = 10'000'000;

/** The largest coordinate, mm: 1 km. */
constexpr double FarthestLandmark = 1e6;

/** A point that has a name. Numbers that the file does not say are NaN. */
struct Landmark
{
  glm::dvec3 position{ 0.0 };                                  ///< mm, RAS
  std::string label;                                           ///< UTF-8; empty: none
  double number = std::numeric_limits<double>::quiet_NaN();    ///< place in the file, from 1 on
  double time = std::numeric_limits<double>::quiet_NaN();      ///< in the list's timeUnit
  double deviation = std::numeric_limits<double>::quiet_NaN(); ///< mm
};

/** What a file holds. */
struct LandmarkList
{
  std::vector<Landmark> points;
  std::string timeUnit; ///< of their times, as the file says it, such as ms; empty: not said
  std::vector<std::string> notes; ///< what was left out: ends of sentences, after the file's name
};

/** The world axes in which a file keeps positions. */
enum class FileAxes
{
  RAS,
  LPS,
};

/** A position from one of the axes to the other: both ways reverse x and y. */
inline glm::dvec3 inAxes(FileAxes axes, const glm::dvec3& ras)
{
  return axes == FileAxes::RAS ? ras : glm::dvec3(-ras.x, -ras.y, ras.z);
}

/** The axes that a word of a file names: RAS or 0, LPS or 1, in capitals or not. */
FileAxes axesFrom(const std::string& word);

/**
 * Adds a point, which must be within the limits.
 *
 * @param where   of the file, such as "line 12"
 */
void addLandmark(LandmarkList& list, Landmark point, const std::string& where);

/** The beginning of a sentence about a part of the file, such as "line 12". */
std::string beginningAt(const std::string& where);

/** Adds a note that is not there yet. */
void noteOnce(LandmarkList& list, const std::string& note);

/** Notes how many points were left out for want of a position. */
void noteSkipped(LandmarkList& list, std::size_t skipped);

/** What a table itself does not tell. */
struct TableRule
{
  FileAxes axes = FileAxes::RAS;    ///< of columns that are called x, y and z
  std::vector<std::string> columns; ///< names of those of the position; none: what they are called
  double mm = 1.0;                  ///< of one unit, if no name of a column tells it
  bool isSaidBeside = false;        ///< a coordsystem.json says the unit, and perhaps the axes
  bool hasAxesBeside = false;       ///< it says the axes
};

/** What the reader of a file is told beside its text. Each format takes what concerns it. */
struct LandmarkChoice
{
  int volume = 0;  ///< of an MNI tag file, whose points are read: 1 or 2; 0: the first, with a note
  TableRule table; ///< of a table
};

/** A format of landmarks. Formats/README.md has the recipe for a new one. */
struct LandmarkFormat
{
  std::vector<std::string> (*endings)(); ///< of names of files, such as ".fcsv"
  bool (*looksLike)(const std::string& beginning);
  /** Adds points and notes, or throws the end of a sentence after the name of the file. */
  void (*read)(const std::string& text, const LandmarkChoice& choice, LandmarkList& list);
  /** Writes all points. What the format cannot hold of them becomes a note of the list. */
  void (*write)(std::ostream& file, FileAxes axes, LandmarkList& list);
  FileAxes axes = FileAxes::RAS; ///< in which it is written if the user chooses none
  bool hasOneFrame = false;      ///< whether it cannot be written in others
  bool isUtf8 = false;           ///< text that is none is refused, not read as Latin-1
  bool holdsNumbers = false;     ///< whether it holds times and deviations
};

/** All formats of landmarks. brainshift_add_format writes this list. */
const std::vector<const LandmarkFormat*>& landmarkFormats();
}

#endif

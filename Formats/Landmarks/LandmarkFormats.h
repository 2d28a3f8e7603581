// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Landmarks and traced points as files keep them, the limits that files must hold, and the
/// formats. They take text and give points in RAS mm. What is wrong in a text is thrown as the end
/// of a sentence, after the name of the file.
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
  double time = std::numeric_limits<double>::quiet_NaN();      ///< in the unit of the file
  double deviation = std::numeric_limits<double>::quiet_NaN(); ///< in the unit of the file
};

/** What a file holds. */
struct LandmarkList
{
  std::vector<Landmark> points;
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

/** Notes how many points were left out for want of a position. */
void noteSkipped(LandmarkList& list, std::size_t skipped);

///@{
/** Markups of Slicer (.mrk.json), MarkupsFile.cxx. One list of the type Fiducial is written. */
void readMarkups(const std::string& text, LandmarkList& list);
bool looksLikeMarkups(const std::string& beginning);
void writeMarkups(std::ostream& file, FileAxes axes, const LandmarkList& list);
///@}

///@{
/** Fiducials of Slicer (.fcsv), FiducialFile.cxx. They are written as Slicer 5 does. */
void readFiducials(const std::string& text, LandmarkList& list);
bool looksLikeFiducials(const std::string& beginning);
void writeFiducials(std::ostream& file, FileAxes axes, const LandmarkList& list);
///@}

///@{
/** What a table itself does not tell. */
struct TableRule
{
  FileAxes axes = FileAxes::RAS;    ///< of columns that are called x, y and z
  std::vector<std::string> columns; ///< names of those of the position; none: what they are called
  double mm = 1.0;                  ///< of one unit, if no name of a column tells it
};

/**
 * Tables (.csv, .tsv), PointTable.cxx. Written columns are called r, a, s or l, p, s.
 */
void readPointTable(const std::string& text, const TableRule& rule, LandmarkList& list);
bool looksLikePointTable(const std::string& beginning);
void writePointTable(std::ostream& file, FileAxes axes, char separator, const LandmarkList& list);
///@}

///@{
/**
 * MNI Tag Point Files (.tag), TagFile.cxx. `volume`, 1 or 2, is the one whose points are read.
 * Those of one volume are written. Quotes in labels become apostrophes, new lines spaces.
 */
void readTags(const std::string& text, int volume, LandmarkList& list);
bool looksLikeTags(const std::string& beginning);
void writeTags(std::ostream& file, const LandmarkList& list);
bool isChangedInTags(const std::string& label);
///@}
}

#endif

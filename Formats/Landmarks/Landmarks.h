// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Landmarks and traced points as files keep them, and the limits that files must hold.
 */
#ifndef BrainShift_Landmarks_h
#define BrainShift_Landmarks_h

#include <glm/vec3.hpp>

#include <cstddef>
#include <limits>
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

/**
 * The axes that a word of a file names: RAS or 0, LPS or 1, in capitals or not. Returns the end of
 * a sentence, after the name of the file, if it is another word; empty if it is one of them.
 */
std::string axesFrom(const std::string& word, FileAxes& axes);

/**
 * Adds a point. Returns the end of a sentence if it lies nowhere or is one too many; else empty.
 *
 * @param where   of the file, such as "line 12"
 */
std::string addLandmark(LandmarkList& list, Landmark point, const std::string& where);

/** What is wrong at a place of the file, such as "line 12": the end of a sentence. */
std::string problemAt(const std::string& where, const std::string& problem);

/** Notes how many points were left out for want of a position. */
void noteSkipped(LandmarkList& list, std::size_t skipped);
}

#endif

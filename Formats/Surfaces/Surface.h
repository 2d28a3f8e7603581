// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Surfaces and tracts as files keep them, and the limits that files must hold.
 */
#ifndef BrainShift_Surface_h
#define BrainShift_Surface_h

#include "Common/LabelTable.h"
#include "Formats/Files/PackedBytes.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace brainshift
{
/** The largest coordinate, mm: 1 km. */
constexpr double FarthestPoint = 1e6;

/** How numbers lie in memory. */
enum class NumberType
{
  UInt8,
  Int32,
  Float32,
  Float64,
};

/** Bytes of one number. */
std::size_t bytesOf(NumberType type);

/** Numbers of points or streamlines. */
struct NamedNumbers
{
  std::string name; ///< UTF-8
  NumberType type = NumberType::Float32;
  std::size_t components = 1; ///< numbers of each point or streamline, side by side
  std::vector<char> bytes;    ///< the numbers, in the order of this machine
};

/** Gives each array a name of its own: the second "a" becomes "a 2". */
class OwnNames
{
public:
  /** The name, or the name with the first number that makes it another than those before. */
  std::string own(const std::string& name);

private:
  std::set<std::string> Taken;
  std::map<std::string, int> Next; // number to try for the next array of a name
};

/** Triangles. */
struct Surface
{
  std::vector<glm::dvec3> points;    ///< mm, in the frame of the file until it is placed
  std::vector<glm::ivec3> triangles; ///< indices of points, counter-clockwise from outside
  std::vector<NamedNumbers> numbers; ///< of the points
  OwnNames names;                    ///< of the numbers
  std::vector<Label> labels;         ///< names of the values of a map of labels
  glm::dmat4 worldFromStored{ 1.0 }; ///< mm, RAS
  bool knowsWorld = true;            ///< false: the file does not say where it lies
  std::vector<std::string> notes;    ///< ends of sentences, after the name of the file
};

/** Streamlines. */
struct Tracts
{
  std::vector<glm::vec3> points;           ///< mm, RAS, one streamline after another
  std::vector<std::int64_t> firsts{ 0 };   ///< first point of each streamline, and the end
  std::vector<NamedNumbers> ofPoints;      ///< of the points
  std::vector<NamedNumbers> ofStreamlines; ///< of the streamlines
  bool knowsWorld = true;                  ///< false: the file does not say where it lies
  std::vector<std::string> notes;          ///< ends of sentences, after the name of the file
};

/** Why a point lies nowhere: the end of a sentence. Empty if it lies somewhere. */
std::string placeProblem(const glm::dvec3& point, const std::string& what);

/**
 * Puts a surface where worldFromStored says. Returns the end of a sentence on what no surface may
 * have: a point that lies nowhere, or a triangle of points that are not there.
 */
std::string placeSurface(Surface& surface);

/** The bytes of a file, with progress. */
struct FileBytes
{
  std::vector<char> bytes;
  bool isStopped = false; ///< told to stop: nothing was read
};

/**
 * Reads all of a file.
 *
 * @param timesInMemory   bytes that the reader will hold in all for each byte of the file
 * @return the end of a sentence, after the name of the file, on why it cannot; empty if it can
 */
std::string readFileBytes(
  const std::string& fileName, double timesInMemory, const ShareDone& shareDone, FileBytes& file);

/** "1 streamline" or "2 streamlines". */
std::string counted(std::size_t count, const std::string& noun);
}

#endif

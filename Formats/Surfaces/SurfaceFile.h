// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Surfaces and tracts as files keep them, the limits of all files, and the formats that read them.
/// The first bytes of a file tell which it is.
#ifndef BrainShift_SurfaceFile_h
#define BrainShift_SurfaceFile_h

#include "Common/LabelTable.h"
#include "Common/Problem.h"
#include "Common/WorldAxes.h"
#include "Formats/Files/PackedBytes.h"

#include <glm/glm.hpp>

#include <map>
#include <set>

namespace brainshift
{
// From FreeSurfer's surface frame (tkRAS) to that of the scanner, mm.
//
// tkRAS has its origin in the middle of a volume and runs along the volume's axes: x against the
// columns' axis, y along the slices' axis, z against the rows' axis. Which axes the volume has in
// the scanner's RAS, and where its middle lies, are the volume's geometry.

/** What a user says of the volume from which a surface was made, for files that do not say it. */
struct GivenVolume
{
  std::string fileName;   ///< of the volume; empty: none
  glm::dvec3 cRas{ 0.0 }; ///< its middle (mm, scanner RAS), where there is no file; 0 0 0: none
};

/** The geometry of a volume. The names are FreeSurfer's: unit vectors and mm, scanner RAS. */
struct VolumeFrame
{
  glm::dvec3 xRas{ -1.0, 0.0, 0.0 }; ///< along columns
  glm::dvec3 yRas{ 0.0, 0.0, -1.0 }; ///< along rows
  glm::dvec3 zRas{ 0.0, 1.0, 0.0 };  ///< along slices
  glm::dvec3 cRas{ 0.0 };            ///< the voxel in the middle, at half the sides
};

/** Takes tkRAS to the scanner's RAS. */
glm::dmat4 scannerFromSurface(const VolumeFrame& frame);

/** Where the voxels of a volume lie. */
struct VolumeGrid
{
  glm::dmat4 worldFromVoxel{ 1.0 }; ///< mm, RAS
  glm::ivec3 dimensions{ 0 };
};

/**
 * Where the voxels of a file lie, in its own order: FreeSurfer (.mgz, .mgh) or NIfTI. Throws one
 * sentence, without a full stop.
 */
VolumeGrid readVolumeGrid(const std::string& fileName);

/** The geometry of a volume whose voxels lie so. */
VolumeFrame frameOf(const VolumeGrid& grid);

/** The largest coordinate, mm: 1 km. */
constexpr double FarthestPoint = 1e6;

/** How numbers lie in memory. */
enum class NumberType
{
  Int8,
  UInt8,
  Int16,
  UInt16,
  Int32,
  UInt32,
  Int64,
  UInt64,
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

/** The half of a brain that a file is of. */
enum class Hemisphere
{
  Unknown,
  Left,
  Right,
};

/** The only hemisphere of which one of some words is: "lh" and "L", or "CortexLeft". */
Hemisphere hemisphereOf(const std::vector<std::string>& words);

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
  Template space = Template::None;   ///< whose space the file says that it is in
  std::vector<std::string> notes;    ///< ends of sentences, after the name of the file
  ///@{
  /** As the content of a file says: that of the points, or of the last file of values. */
  Hemisphere ofPoints = Hemisphere::Unknown;
  Hemisphere ofValues = Hemisphere::Unknown;
  ///@}
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

/** Throws the end of a sentence if a point lies nowhere. */
void requirePoint(const glm::dvec3& point, const std::string& what);

/** "1 streamline" or "2 streamlines". */
std::string counted(std::size_t count, const std::string& noun);

/** A format of surfaces. Formats/README.md has the recipe for a new one. */
struct SurfaceFormat
{
  bool (*isOne)(const std::string& fileName); ///< whether a file begins like a surface
  ///@{
  /** Throw the end of a sentence, after the name of the file. */
  void (*read)(const std::vector<char>& bytes, const GivenVolume& volume, Surface& surface);
  /** Adds a map of values, called `name` if the file does not name it. It was recognised. */
  void (*addValues)(const std::vector<char>& bytes, const std::string& name, Surface& surface);
  ///@}
  bool (*isOfValues)(const std::vector<char>& bytes); ///< whether bytes begin like a map of values
  const char* values; ///< such a file in a sentence, with its article
};

/** Where streamlines are read from. */
struct TractSource
{
  std::string fileName;   ///< a file, or a folder where a format has those
  std::string volumeName; ///< for files of TrackVis without vox_to_ras; empty: none
};

/** The voxels that a file of streamlines names, in RAS. */
struct TractBox
{
  glm::ivec3 dimensions{ 1 };
  glm::dmat4 worldFromVoxel{ 1.0 }; ///< mm
};

/** Ends of sentences, after the name of the file, on what was left out. */
using TractNotes = std::vector<std::string>;

/** A format of streamlines. */
struct TractFormat
{
  bool (*isOne)(const std::string& fileName); ///< whether a file, packed or not, begins like one
  /**
   * Reads the bytes of a file, whose order it may reverse, or throws the end of a sentence. Of a
   * folder there are no bytes. There are no points if it was told to stop.
   */
  void (*read)(std::vector<char>& bytes, const TractSource& source,
    const FractionDone& fractionDone, Tracts& tracts);
  const char* ending; ///< of names of files to write, with a full stop
  /** Writes a file. Throws a sentence, without a full stop. */
  void (*write)(
    const std::string& fileName, const Tracts& tracts, const TractBox& box, TractNotes& notes);
};

///@{
/** All formats of surfaces and of streamlines. brainshift_add_format writes these lists. */
const std::vector<const SurfaceFormat*>& surfaceFormats();
const std::vector<const TractFormat*>& tractFormats();
///@}

/** Whether a file begins like a surface. */
bool isSurfaceFile(const std::string& fileName);

/** Whether a file begins like one of streamlines. */
bool isTractFile(const std::string& fileName);

/** Files that together are one surface. */
struct SurfaceFiles
{
  std::string fileName;                    ///< the points and triangles
  std::vector<std::string> valueFileNames; ///< numbers of the points: FreeSurfer's maps, or GIFTI
  GivenVolume volume;
};

/**
 * Reads a surface into RAS mm, or throws one sentence, without a full stop. If it was told to stop,
 * the surface has no points.
 *
 * @param warnings   gets sentences, without full stops, on what the user must know
 */
void readSurfaceFiles(const SurfaceFiles& files, const FractionDone& fractionDone, Surface& surface,
  std::vector<std::string>& warnings);

/**
 * Reads streamlines into RAS mm, as readSurfaceFiles does. A file may be packed with gzip.
 */
void readTractFile(const TractSource& source, const FractionDone& fractionDone, Tracts& tracts,
  std::vector<std::string>& warnings);

/**
 * Writes streamlines in RAS mm in the format that the ending of the name says, or throws one
 * sentence, without a full stop.
 *
 * @param volumeName   whose voxels the file names: .mgz, .mgh or NIfTI. Empty: a box of 1 mm around
 *                     the points
 * @param warnings     gets sentences, without full stops, on what the file cannot hold
 */
void writeTractFile(const std::string& fileName, const std::string& volumeName,
  const Tracts& tracts, std::vector<std::string>& warnings);
}

#endif

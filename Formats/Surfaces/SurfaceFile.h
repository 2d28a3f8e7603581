// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Reads surfaces and tracts of all formats. The first bytes of a file tell which it is.
 */
#ifndef BrainShift_SurfaceFile_h
#define BrainShift_SurfaceFile_h

#include "Formats/Surfaces/ScannerFrame.h"
#include "Formats/Surfaces/Surface.h"

#include <string>
#include <vector>

namespace brainshift
{
/** A format of surfaces. Formats/README.md has the recipe for a new one. */
struct SurfaceFormat
{
  bool (*isOne)(const std::string& fileName); ///< whether a file begins like a surface
  ///@{
  /** Return the end of a sentence, after the name of the file, on what is wrong; else empty. */
  std::string (*read)(const std::vector<char>& bytes, const GivenVolume& volume, Surface& surface);
  /** Adds a map of values, called `name` if the file does not name it. It was recognised. */
  std::string (*addValues)(
    const std::vector<char>& bytes, const std::string& name, Surface& surface);
  ///@}
  bool (*isOfValues)(const std::vector<char>& bytes); ///< whether bytes begin like a map of values
  const char* values; ///< such a file in a sentence, with its article
};

/** A format of streamlines. */
struct TractFormat
{
  bool (*isOne)(const std::string& fileName); ///< whether a file begins like one
  /**
   * Reads the bytes of a file, whose order it may reverse. `volumeName`: as for readTractFile.
   * Returns the end of a sentence on what is wrong; empty if nothing is, or if it was told to stop.
   */
  std::string (*read)(std::vector<char>& bytes, const std::string& volumeName,
    const ShareDone& shareDone, Tracts& tracts);
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
 * Reads a surface into RAS mm. Returns one sentence, without a full stop, on what is wrong; empty
 * if nothing is, or if it was told to stop: then the surface has no points.
 *
 * @param warnings   gets sentences, without full stops, on what the user must know
 */
std::string readSurfaceFiles(const SurfaceFiles& files, const ShareDone& shareDone,
  Surface& surface, std::vector<std::string>& warnings);

/**
 * Reads streamlines into RAS mm, as readSurfaceFiles does.
 *
 * @param volumeName   for files of TrackVis without vox_to_ras; empty: none
 */
std::string readTractFile(const std::string& fileName, const std::string& volumeName,
  const ShareDone& shareDone, Tracts& tracts, std::vector<std::string>& warnings);
}

#endif

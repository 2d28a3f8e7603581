// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Writers/WrittenVolume.h"

#include "Common/HostMemory.h"
#include "Formats/Files/ByteSink.h"
#include "Formats/Files/Text.h"
#include "Formats/Files/WholeFile.h"
#include "Formats/Writers/WrittenHeader.h"

#include <algorithm>
#include <cstring>
#include <vector>

namespace brainshift
{
namespace
{
constexpr std::size_t PieceBytes = std::size_t(1) << 22; // between two reports of progress

// What goes into a file, and how.
struct Contents
{
  std::string header;
  bool isPacked = false;    // with gzip
  bool partsVoxels = false; // all numbers of the first component come first
  bool isKnown = false;     // the format
};

Contents contentsOf(const std::string& fileName, const OutgoingVolume& volume)
{
  const bool isPacked = endsWith(fileName, ".nii.gz");
  if (isPacked || endsWith(fileName, ".nii"))
  {
    return { niftiHeader(volume), isPacked, volume.components() > 1 && !isNIFTIColour(volume),
      true };
  }
  if (endsWith(fileName, ".mha") || endsWith(fileName, ".mhd"))
  {
    return { metaImageHeader(volume), false, false, true };
  }
  if (endsWith(fileName, ".nrrd"))
  {
    return { nrrdHeader(volume), false, false, true };
  }
  return {};
}

std::string sizeProblem(const std::string& fileName, const OutgoingVolume& volume)
{
  const glm::ivec3& sides = volume.grid.dimensions;
  const int longest = std::max({ sides.x, sides.y, sides.z, volume.components() });
  const bool isNIFTI = endsWith(fileName, ".nii") || endsWith(fileName, ".nii.gz");
  if (isNIFTI && longest > LongestNIFTISide)
  {
    return "File " + fileName + " cannot be written: the input has " + sizeText(glm::dvec3(sides)) +
      " voxels of " + std::to_string(volume.components()) + " components; NIfTI holds at most " +
      std::to_string(LongestNIFTISide) + " of each";
  }
  return {};
}

// Hands the sink all numbers in pieces. False if the user stops.
bool writeAll(const OutgoingVolume& volume, const Progress& progress, ByteSink& sink)
{
  const char* next = volume.bytes();
  std::size_t left = volume.bytesOfVolume();
  bool proceeds = true;
  while (proceeds && left > 0)
  {
    const std::size_t piece = std::min(left, PieceBytes);
    if (!sink.write(next, piece))
    {
      return true; // the sink says why
    }
    next += piece;
    left -= piece;
    proceeds = progress(1.0 - static_cast<double>(left) / volume.bytesOfVolume());
  }
  return proceeds;
}

// The same, one component after the other.
bool writeParted(const OutgoingVolume& volume, const Progress& progress, ByteSink& sink)
{
  const std::size_t number = volume.type.bytes;
  const std::size_t voxels = volume.grid.count();
  const std::size_t most = PieceBytes / number;
  std::vector<char> piece;
  const int components = volume.components();
  for (int component = 0; component < components; ++component)
  {
    for (std::size_t first = 0; first < voxels; first += most)
    {
      const std::size_t count = std::min(most, voxels - first);
      piece.resize(count * number);
      const char* from = volume.bytes() + first * volume.bytesOfVoxel() + component * number;
      for (std::size_t i = 0; i < count; ++i)
      {
        std::memcpy(piece.data() + i * number, from + i * volume.bytesOfVoxel(), number);
      }
      if (!sink.write(piece.data(), piece.size()))
      {
        return true; // the sink says why
      }
      if (!progress((component + static_cast<double>(first + count) / voxels) / components))
      {
        return false;
      }
    }
  }
  return true;
}
}

std::string writeVolume(
  const std::string& fileName, const OutgoingVolume& volume, const Progress& progress)
{
  const std::string tooLarge = sizeProblem(fileName, volume);
  if (!tooLarge.empty())
  {
    return tooLarge;
  }
  const Contents contents = contentsOf(fileName, volume);
  if (!contents.isKnown)
  {
    return "The extension of the volume " + fileName +
      " must be .nii, .nii.gz, .mha, .mhd or .nrrd";
  }
  return writeWhole(fileName, [&](const std::string& beside) {
    ByteSink sink(beside, contents.isPacked);
    sink.write(contents.header.data(), contents.header.size());
    const bool proceeds =
      contents.partsVoxels ? writeParted(volume, progress, sink) : writeAll(volume, progress, sink);
    const std::string problem = sink.close();
    return proceeds ? problem : std::string("it was stopped");
  });
}
}

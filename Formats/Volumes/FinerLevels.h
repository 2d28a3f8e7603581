// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The finer levels of a file with several, of which an array holds one: where they are, and how
/// parts of them are read.
#ifndef BrainShift_FinerLevels_h
#define BrainShift_FinerLevels_h

#include "Formats/Volumes/PlacedVolume.h"

#include <optional>

namespace brainshift
{
///@{
/**
 * Field arrays of a format with levels: which one the volume has, 0 being the finest, and how many
 * voxels along each of the file's axes are packed together.
 */
constexpr const char* LevelArray = "OMEZarrLevel";
constexpr const char* ChunkArray = "OMEZarrChunk";
///@}

/** What a reader read an array from. */
struct LevelSource
{
  const VolumeFormat* format = nullptr;
  std::string fileName;
  std::string choice;
  int level = 0; ///< that the array holds; those below are finer
  int channel = -1;
  std::size_t volume = 0; ///< of the times
  glm::dmat4 worldFromFile{ 1.0 };
  Grid grid{};           ///< of the array
  int type = 0;          ///< of its numbers, of vtkType.h
  int components = 0;    ///< for each voxel
  vtkMTimeType time = 0; ///< of the array when it was read

  VTKBRAINSHIFTFORMATS_EXPORT bool operator==(const LevelSource& other) const;
};

/**
 * Remembers what the scalars of an image were read from, for as long as they live and are not
 * modified. The level is that of the header; the image has the rest.
 */
void rememberLevels(vtkImageData* image, LevelSource source, const VolumeHeader& header);

/**
 * What an array, or one that shares its memory, was read from, if there are finer levels. None for
 * arrays that a filter made or another process sent: their numbers are not those of the file, or
 * may not be.
 */
VTKBRAINSHIFTFORMATS_EXPORT std::optional<LevelSource> finerLevelsOf(vtkDataArray* numbers);

/** Reads parts of the finer levels. One thread at a time. */
class VTKBRAINSHIFTFORMATS_EXPORT FinerLevels
{
public:
  /**
   * Reads the headers of all levels that are finer, or throws a sentence: also if their numbers are
   * of another type than those of the array.
   */
  explicit FinerLevels(const LevelSource& source);
  ~FinerLevels();

  /** Where the voxels of each level lie, the finest first. */
  const std::vector<Grid>& grids() const { return this->Grids; }

  /** Voxels of a level, a side of a cube, that are best read at once. */
  int blockSide(std::size_t level) const;

  /**
   * The numbers of a level in an extent of its grid, x fastest. Throws a sentence. Null: `progress`
   * said stop. `damage`: a sentence on what a coarser level had to replace; empty if nothing.
   */
  vtkSmartPointer<vtkDataArray> read(
    std::size_t level, const int extent[6], const Progress& progress, std::string& damage);

private:
  std::size_t Volume;
  std::vector<std::unique_ptr<PlacedVolume>> Levels;
  std::vector<Grid> Grids;
};
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Volumes in MetaImage (.mha, .mhd) and NRRD (.nrrd, .nhdr) files.
 *
 * Three axes must be axes of space. One axis before them is the components of a voxel, or time, or
 * the layers of a segmentation; one after them is time.
 */
#ifndef BrainShift_TextHeaderVolume_h
#define BrainShift_TextHeaderVolume_h

#include "Formats/Files/TextHeader.h"
#include "Formats/Volumes/VolumeFile.h"

#include "vtkDataArray.h" // for its smart pointer

#include <cstddef>
#include <string>
#include <vector>

namespace brainshift
{
/** The two formats. */
enum class TextFormat
{
  MetaImage,
  NRRD,
};

/** Whether a file begins like a volume of one of the formats, and no image of two dimensions. */
bool isTextHeaderVolume(const std::string& fileName, TextFormat format);

/** See VolumeFile. */
class TextHeaderVolume : public VolumeFile
{
public:
  explicit TextHeaderVolume(TextFormat format);

  std::string noun() const override;
  std::string readHeader(const std::string& fileName, VolumeHeader& header) override;
  double storedBytes(const VolumeHeader& header) const override;
  std::string load(std::size_t volume, const Progress& progress, StoredVoxels& voxels) override;

  /**
   * Which layer of a segmentation the next readHeader takes: one of the choices, or its number.
   * Default: empty, the first, with a warning. Other volumes have no layers to choose from.
   */
  void choose(const std::string& name) override { this->Layer = name; }

  /**
   * The layers that the last readHeader found, such as "2: vessel, tumour". None if segments cannot
   * overlap.
   */
  std::vector<std::string> choices() const override { return this->LayerNames; }

private:
  // How the axes of the file are used.
  std::string arrange(VolumeHeader& header);
  // One layer of a segmentation, with its labels.
  std::string takeSegments(VolumeHeader& header);
  std::string readAll(const Progress& progress, bool& stopped);

  TextFormat Format;
  std::string Layer;
  std::vector<std::string> LayerNames;
  int ShownLayer = 0;
  TextHeader Stored;
  glm::ivec3 Dimensions{ 0 };
  std::size_t Tuple = 1;    // numbers of the axis before those of space
  bool TupleIsTime = false; // its numbers are volumes
  std::size_t Steps = 1;    // volumes along the axis after those of space
  // All numbers, kept for the other volumes of a series.
  vtkSmartPointer<vtkDataArray> Numbers;
};
}

#endif

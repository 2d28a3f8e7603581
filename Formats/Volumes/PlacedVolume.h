// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A volume of any format, placed in RAS millimetres.
///
/// Voxels are permuted and flipped, never resampled, so that the axes of the image run along the
/// nearest RAS axes (RasGrid.h). Numbers keep the file's type. Where they are rescaled they become
/// float32, or double if float32 lacks digits for the file's type.
#ifndef BrainShift_PlacedVolume_h
#define BrainShift_PlacedVolume_h

#include "Formats/Volumes/RasGrid.h"
#include "Formats/Volumes/VolumeFile.h"

class vtkImageData;

namespace brainshift
{
/** Reads through a VolumeFile: first the header, then voxels. */
class PlacedVolume
{
public:
  explicit PlacedVolume(std::unique_ptr<VolumeFile> file);

  /** Reads the header of a file, or throws one sentence. */
  void readHeader(const std::string& fileName);

  /** From the RAS of the next header to the world (mm). Default: the identity. */
  void setPlacement(const glm::dmat4& worldFromFile) { this->WorldFromFile = worldFromFile; }

  /** Whether the last header was good. All that follows is of that file. */
  bool isPlaced() const { return this->Placed; }

  /** Sentences, without full stops, on what the user must know, such as shear. */
  std::vector<std::string> warnings() const;

  /** What the file says. */
  const VolumeHeader& header() const { return this->Header; }

  /** Where the voxels lie. */
  const RasGrid& geometry() const { return this->Geometry; }

  /** VTK's number of the type that the voxels are handed out in. */
  int scalarType() const;

  /**
   * Fills an image over `extent` with one volume; `volume` is an index of the header's times.
   * Throws one sentence. If `progress` says stop, the image keeps what it had.
   */
  void read(std::size_t volume, const int extent[6], const Progress& progress, vtkImageData* image);

  /** A sentence, without a full stop, on what the last `read` could not read. Empty: nothing. */
  const std::string& damage() const { return this->Damage; }

private:
  void requireMemory(const int extent[6]) const;
  std::string sentence(const std::string& end) const;
  std::string shearWarning() const;

  std::unique_ptr<VolumeFile> File;
  std::string FileName;
  glm::dmat4 WorldFromFile{ 1.0 };
  std::string Damage;
  bool Placed = false;
  VolumeHeader Header;
  RasGrid Geometry;
};

/** The volume of a file of any format, its header read. Throws one sentence. */
PlacedVolume openVolume(const std::string& fileName);
}

#endif

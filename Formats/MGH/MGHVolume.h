// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Volumes of FreeSurfer: .mgh, and .mgz or .mgh.gz packed with gzip.
///
/// Their world is the scanner's RAS, in mm; FreeSurfer's tkRAS is not used. All numbers are big
/// endian. Frames become time steps.
#ifndef BrainShift_MGHVolume_h
#define BrainShift_MGHVolume_h

#include "Formats/Files/PackedBytes.h"
#include "Formats/Volumes/VolumeFile.h"

#include "vtkDataArray.h" // for its smart pointer

namespace brainshift
{
/** Whether a file exists and begins like a volume of FreeSurfer. */
bool isMGHFile(const std::string& fileName);

/** See VolumeFile. */
class MGHVolume : public VolumeFile
{
public:
  std::string noun() const override { return "FreeSurfer volume"; }
  void readHeader(const std::string& fileName, VolumeHeader& header) override;
  double storedBytes(const VolumeHeader& header) const override;
  Loads loads() const override { return Loads::Part; } ///< of all frames if they are packed
  bool readsNothingElse() const override { return !this->From.isPacked; }
  void load(std::size_t volume, const Progress& progress, StoredVoxels& voxels) override;

private:
  bool keepsFrames() const { return this->From.isPacked && this->Frames > 1; }

  StoredBytes From; // the voxels of all frames
  glm::ivec3 Dimensions{ 0 };
  int Frames = 1;
  int Type = VTK_VOID;
  // A part of all frames of a packed file, kept for the next one, and which part it is.
  vtkSmartPointer<vtkDataArray> Numbers;
  std::array<int, 6> Held{};
};
}

#endif

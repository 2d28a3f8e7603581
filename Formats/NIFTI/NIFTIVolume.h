// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Volumes in NIfTI-1 and NIfTI-2 files: .nii, .nii.gz, and pairs of .hdr and .img.
///
/// The sform counts before the qform (NIFTIHeader.h). scl_slope and scl_inter rescale the numbers;
/// a slope of 0 or NaN does not, and colours are never rescaled. VTK's reader reads the voxels.
#ifndef BrainShift_NIFTIVolume_h
#define BrainShift_NIFTIVolume_h

#include "Formats/Volumes/VolumeFile.h"

#include "vtkCallbackCommand.h" // for its smart pointer
#include "vtkNIFTIImageReader.h"
#include "vtkNew.h"

namespace brainshift
{
struct NIFTIPlacement;

/** See VolumeFile. */
class NIFTIVolume : public VolumeFile
{
public:
  NIFTIVolume();

  std::string noun() const override { return "NIfTI file"; }
  void readHeader(const std::string& fileName, VolumeHeader& header) override;
  Loads loads() const override { return Loads::Part; } ///< of a series at all times: it is kept
  bool readsNothingElse() const override { return this->Volumes == 1 && !this->IsPacked; }
  double storedBytes(const VolumeHeader& header) const override;
  void load(std::size_t volume, const Progress& progress, StoredVoxels& voxels) override;

  /** An affine of the last header with the slices in the file's order, which VTK may reverse. */
  glm::dmat4 inFileOrder(const glm::dmat4& worldFromVoxel, const glm::ivec3& dimensions) const;

  /** What the last header says of the positions of voxels. */
  NIFTIPlacement placement() const;

private:
  // The text that may name labels. Notes extensions that reach into the voxels.
  std::string textOfExtensions(const std::string& fileName, VolumeHeader& header);

  // Whether VTK reads slices from the last to the first.
  bool reversesSlices() const;

  bool isRead(int extent[6], const Progress& progress);

  std::string Error; // of Voxels
  vtkNew<vtkCallbackCommand> KeepError;
  vtkNew<vtkNIFTIImageReader> Voxels; // all volumes of a time series as components
  int Volumes = 1;
  bool IsPacked = false; // with gzip
};
}

#endif

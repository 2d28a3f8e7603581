// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Volumes in NIfTI-1 and NIfTI-2 files: .nii, .nii.gz, and pairs of .hdr and .img.
 *
 * The sform counts before the qform (NIFTIGeometry.h). scl_slope and scl_inter rescale the numbers;
 * a slope of 0 or NaN does not, and colours are never rescaled. VTK's reader reads the voxels.
 */
#ifndef BrainShift_NIFTIVolume_h
#define BrainShift_NIFTIVolume_h

#include "Formats/Volumes/VolumeFile.h"

#include "vtkCallbackCommand.h" // for its smart pointer
#include "vtkNIFTIImageReader.h"
#include "vtkNew.h"

#include <cstddef>
#include <string>

namespace brainshift
{
/** See VolumeFile. */
class NIFTIVolume : public VolumeFile
{
public:
  NIFTIVolume();

  std::string noun() const override { return "NIfTI file"; }
  std::string readHeader(const std::string& fileName, VolumeHeader& header) override;
  double storedBytes(const VolumeHeader& header) const override;
  std::string load(std::size_t volume, const Progress& progress, StoredVoxels& voxels) override;

  /** Whether VTK reads the slices of the last file from the last to the first. */
  bool reversesSlices() const;

private:
  std::string Error; // of Voxels
  vtkNew<vtkCallbackCommand> KeepError;
  vtkNew<vtkNIFTIImageReader> Voxels; // all volumes of a time series as components
  int Volumes = 1;
};
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Volumes in DICOM: series of slices, and multi-frame files.
 */
#ifndef BrainShift_DICOMVolume_h
#define BrainShift_DICOMVolume_h

#include "Formats/DICOM/DICOMFolder.h"
#include "Formats/DICOM/DICOMStack.h"
#include "Formats/Volumes/VolumeFile.h"

#include <cstddef>
#include <string>
#include <vector>

namespace brainshift
{
/** See VolumeFile. A file name may name a folder. */
class VTKBRAINSHIFTFORMATS_EXPORT DICOMVolume : public VolumeFile
{
public:
  std::string noun() const override { return "DICOM series"; }
  std::string readHeader(const std::string& fileName, VolumeHeader& header) override;
  double storedBytes(const VolumeHeader& header) const override;
  std::string load(std::size_t volume, const Progress& progress, StoredVoxels& voxels) override;

  /** The choices are the series of a folder. */
  std::vector<std::string> choices() const override;
  void choose(const std::string& series) override { this->Series = series; }

  void setResamples(bool resamples) override { this->Resamples = resamples; }
  void setScanProgress(const Progress& progress) override { this->ScanProgress = progress; }
  std::string firstFile() const override;

private:
  // Chooses the type of the numbers.
  void decideType(VolumeHeader& header);
  // Fills an image with one volume; drops it if `progress` says stop.
  std::string readImages(
    std::size_t volume, const Progress& progress, vtkSmartPointer<vtkImageData>& image) const;

  std::string Series;
  bool Resamples = false;
  Progress ScanProgress;
  DICOMFolder Folder;
  DICOMStack Stack;
  int StoredType = VTK_VOID; // VTK_FLOAT: numbers are rescaled as they are read
};
}

#endif

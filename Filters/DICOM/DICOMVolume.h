// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Volumes in DICOM: series of slices, and multi-frame files.
 */
#ifndef BrainShift_DICOMVolume_h
#define BrainShift_DICOMVolume_h

#include "Filters/DICOM/DICOMFolder.h"
#include "Filters/DICOM/DICOMStack.h"
#include "Filters/Volumes/VolumeFile.h"

#include <cstddef>
#include <string>
#include <vector>

namespace brainshift
{
/** See VolumeFile. A file name may name a folder. */
class VTKBRAINSHIFTFILTERS_EXPORT DICOMVolume : public VolumeFile
{
public:
  std::string noun() const override { return "DICOM series"; }
  std::string readHeader(const std::string& fileName, VolumeHeader& header) override;
  double storedBytes(const VolumeHeader& header) const override;
  std::string load(std::size_t volume, const Progress& progress, StoredVoxels& voxels) override;

  /** Which series the next readHeader takes. Default: empty, the first of seriesNames. */
  void setSeries(const std::string& name) { this->Series = name; }

  /** Whether uneven or tilted slices are interpolated on an upright grid. Default: false. */
  void setResamples(bool resamples) { this->Resamples = resamples; }

  /** Who hears how far the headers of a folder are read. Default: nobody. */
  void setScanProgress(const Progress& progress) { this->ScanProgress = progress; }

  /** The series that the last readHeader found. The first is shown if nobody chooses. */
  std::vector<std::string> seriesNames() const;

  /** Path of the first image of what the last readHeader took; empty if there is none. */
  std::string firstFile() const;

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

// SPDX-License-Identifier: BSD-3-Clause
// Reads NIfTI-1 and NIfTI-2 volumes (.nii, .nii.gz, .hdr/.img pairs) into RAS millimetres.
//
// The voxels are permuted and flipped, never resampled, so that the image's axes run along the
// nearest RAS axes. What rotation is left (an oblique scan) is the image's direction matrix:
// exactly the identity for scans along the axes, so that filters which ignore directions are right
// too. The sform counts before the qform; with neither, voxel (0,0,0) is the world's origin. A
// sheared sform, which no image can hold, gives a warning with the distance that it costs.
//
// Output: vtkImageData with the point scalars "Intensity". Their type is the file's own, or float32
// where scl_slope and scl_inter rescale (a slope of 0 or NaN does not; colours are never rescaled).
// A time series is offered as time steps, in seconds.
// On an error nothing is read and the output stays as it was, or is empty.
#ifndef vtkNIFTIVolumeReader_h
#define vtkNIFTIVolumeReader_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro
#include "vtkImageAlgorithm.h"

#include <memory>
#include <string>

class VTKBRAINSHIFTFILTERS_EXPORT vtkNIFTIVolumeReader : public vtkImageAlgorithm
{
public:
  static vtkNIFTIVolumeReader* New();
  vtkTypeMacro(vtkNIFTIVolumeReader, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  // The file to read. Default: none, which is an error.
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);

  // 1 if the file is there and begins like NIfTI, else 0.
  int CanReadFile(VTK_FILEPATH const char* fileName);

protected:
  vtkNIFTIVolumeReader();
  ~vtkNIFTIVolumeReader() override;

  int RequestInformation(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkNIFTIVolumeReader(const vtkNIFTIVolumeReader&) = delete;
  void operator=(const vtkNIFTIVolumeReader&) = delete;

  // Fills `Stored` from the header; returns one sentence if it cannot, else an empty string.
  std::string ReadHeader();
  void ReportShear();
  // Makes `Stored` hold the voxels and allocates the output; reports and returns false if it
  // cannot.
  bool LoadVoxels(vtkInformation* information, vtkImageData* shown);

  class StoredVolume;

  char* FileName = nullptr;
  std::unique_ptr<StoredVolume> Stored;
};

#endif

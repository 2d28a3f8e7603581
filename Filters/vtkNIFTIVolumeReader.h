// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkNIFTIVolumeReader
 * @brief   reads NIfTI-1 and NIfTI-2 volumes into RAS millimetres
 *
 * Files: .nii, .nii.gz, and pairs of .hdr and .img. World is RAS: x to the patient's right, y to
 * the front, z to the head.
 *
 * Voxels are permuted and flipped, never resampled, so that the axes of the image run along the
 * nearest RAS axes. The rotation that is left (an oblique scan) becomes the direction matrix of the
 * image. For scans along the axes that matrix is exactly the identity, so filters that ignore
 * directions are right too. The sform counts before the qform; without both, voxel (0, 0, 0) lies
 * at the origin of the world. No image can hold a sheared sform: it gives a warning that names the
 * error in mm.
 *
 * Output: vtkImageData with the point scalars "Intensity". Their type is the type in the file, or
 * float32 if scl_slope and scl_inter rescale them; a slope of 0 or NaN does not rescale, and
 * colours are never rescaled. A time series has time steps, in seconds. After an error the output
 * stays as it was, or is empty.
 */
#ifndef vtkNIFTIVolumeReader_h
#define vtkNIFTIVolumeReader_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro
#include "vtkImageAlgorithm.h"

#include <memory> // for the private part

namespace brainshift
{
class NIFTIVolume;
}

class VTKBRAINSHIFTFILTERS_EXPORT vtkNIFTIVolumeReader : public vtkImageAlgorithm
{
public:
  static vtkNIFTIVolumeReader* New();
  vtkTypeMacro(vtkNIFTIVolumeReader, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;
  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  ///@{
  /** The file to read. Default: none, which is an error. */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  /** 1 if the file exists and begins like a NIfTI file, else 0. */
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

  char* FileName = nullptr;
  std::unique_ptr<brainshift::NIFTIVolume> Stored;
};

#endif

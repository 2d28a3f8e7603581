// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkNIFTIVolumeReader
 * @brief   reads NIfTI-1 and NIfTI-2 volumes into RAS millimetres
 *
 * Files: .nii, .nii.gz, and pairs of .hdr and .img. vtkVolumeFileReader says what the output is.
 *
 * The sform counts before the qform; without both, voxel (0, 0, 0) lies at the origin of the world.
 * scl_slope and scl_inter rescale the numbers; a slope of 0 or NaN does not, and colours are never
 * rescaled.
 */
#ifndef vtkNIFTIVolumeReader_h
#define vtkNIFTIVolumeReader_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro
#include "vtkVolumeFileReader.h"

class VTKBRAINSHIFTFILTERS_EXPORT vtkNIFTIVolumeReader : public vtkVolumeFileReader
{
public:
  static vtkNIFTIVolumeReader* New();
  vtkTypeMacro(vtkNIFTIVolumeReader, vtkVolumeFileReader);

  int CanReadFile(VTK_FILEPATH const char* fileName) override;

protected:
  vtkNIFTIVolumeReader();
  ~vtkNIFTIVolumeReader() override = default;

private:
  vtkNIFTIVolumeReader(const vtkNIFTIVolumeReader&) = delete;
  void operator=(const vtkNIFTIVolumeReader&) = delete;
};

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMGHVolumeReader
 * @brief   reads FreeSurfer volumes into RAS millimetres
 *
 * Files: .mgh, .mgz and .mgh.gz. vtkVolumeFileReader says what the output is.
 *
 * The scanner's RAS counts, not FreeSurfer's tkRAS. Frames become time steps.
 */
#ifndef vtkMGHVolumeReader_h
#define vtkMGHVolumeReader_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro
#include "vtkVolumeFileReader.h"

class VTKBRAINSHIFTFILTERS_EXPORT vtkMGHVolumeReader : public vtkVolumeFileReader
{
public:
  static vtkMGHVolumeReader* New();
  vtkTypeMacro(vtkMGHVolumeReader, vtkVolumeFileReader);

  int CanReadFile(VTK_FILEPATH const char* fileName) override;

protected:
  vtkMGHVolumeReader();
  ~vtkMGHVolumeReader() override = default;

private:
  vtkMGHVolumeReader(const vtkMGHVolumeReader&) = delete;
  void operator=(const vtkMGHVolumeReader&) = delete;
};

#endif

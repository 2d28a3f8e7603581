// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMINCVolumeReader
 * @brief   reads MINC2 volumes into RAS millimetres
 *
 * Files: .mnc. vtkVolumeFileReader says what the output is.
 *
 * libminc reads the file. Whole numbers become float32 by the ranges of their slices; those of the
 * classes integer and label stay as they are. Names of labels are attached. MINC1 is refused.
 */
#ifndef vtkMINCVolumeReader_h
#define vtkMINCVolumeReader_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro
#include "vtkVolumeFileReader.h"

class VTKBRAINSHIFTFILTERS_EXPORT vtkMINCVolumeReader : public vtkVolumeFileReader
{
public:
  static vtkMINCVolumeReader* New();
  vtkTypeMacro(vtkMINCVolumeReader, vtkVolumeFileReader);

  int CanReadFile(VTK_FILEPATH const char* fileName) override;

protected:
  vtkMINCVolumeReader();
  ~vtkMINCVolumeReader() override = default;

private:
  vtkMINCVolumeReader(const vtkMINCVolumeReader&) = delete;
  void operator=(const vtkMINCVolumeReader&) = delete;
};

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkMetaImageVolumeReader
 * @brief   reads MetaImage volumes into RAS millimetres
 *
 * Files: .mha and .mhd. vtkVolumeFileReader says what the output is.
 *
 * The world of the file is LPS, as in ITK. The TransformMatrix counts, not the
 * AnatomicalOrientation; without that matrix, and with the letters ???, the patient's sides
 * are not known.
 * CanReadFile leaves files with a displacement field to vtkDisplacementFieldReader.
 */
#ifndef vtkMetaImageVolumeReader_h
#define vtkMetaImageVolumeReader_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro
#include "vtkVolumeFileReader.h"

class VTKBRAINSHIFTFILTERS_EXPORT vtkMetaImageVolumeReader : public vtkVolumeFileReader
{
public:
  static vtkMetaImageVolumeReader* New();
  vtkTypeMacro(vtkMetaImageVolumeReader, vtkVolumeFileReader);

  int CanReadFile(VTK_FILEPATH const char* fileName) override;

protected:
  vtkMetaImageVolumeReader();
  ~vtkMetaImageVolumeReader() override = default;

private:
  vtkMetaImageVolumeReader(const vtkMetaImageVolumeReader&) = delete;
  void operator=(const vtkMetaImageVolumeReader&) = delete;
};

#endif

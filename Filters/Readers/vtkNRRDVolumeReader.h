// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkNRRDVolumeReader
 * @brief   reads NRRD volumes and label maps into RAS millimetres
 *
 * Files: .nrrd, .nhdr and .seg.nrrd. vtkVolumeFileReader says what the output is.
 *
 * The spaces RAS, LAS and LPS name the patient's sides; scanner-xyz and files without a space do
 * not. Of a segmentation of 3D Slicer with several layers, the first layer is shown.
 * CanReadFile leaves files with a displacement field to vtkDisplacementFieldReader.
 */
#ifndef vtkNRRDVolumeReader_h
#define vtkNRRDVolumeReader_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro
#include "vtkVolumeFileReader.h"

class VTKBRAINSHIFTFILTERS_EXPORT vtkNRRDVolumeReader : public vtkVolumeFileReader
{
public:
  static vtkNRRDVolumeReader* New();
  vtkTypeMacro(vtkNRRDVolumeReader, vtkVolumeFileReader);

  int CanReadFile(VTK_FILEPATH const char* fileName) override;

protected:
  vtkNRRDVolumeReader();
  ~vtkNRRDVolumeReader() override = default;

private:
  vtkNRRDVolumeReader(const vtkNRRDVolumeReader&) = delete;
  void operator=(const vtkNRRDVolumeReader&) = delete;
};

#endif

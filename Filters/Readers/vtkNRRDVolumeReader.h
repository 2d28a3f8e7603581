// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkNRRDVolumeReader
 * @brief   reads NRRD volumes and label maps into RAS millimetres
 *
 * Files: .nrrd, .nhdr and .seg.nrrd. vtkVolumeFileReader says what the output is.
 *
 * The spaces RAS, LAS and LPS name the patient's sides; scanner-xyz and files without a space do
 * not. Of a segmentation of 3D Slicer with several layers, one layer is shown.
 * CanReadFile leaves files with a displacement field to vtkDisplacementFieldReader.
 */
#ifndef vtkNRRDVolumeReader_h
#define vtkNRRDVolumeReader_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro
#include "vtkNew.h"
#include "vtkVolumeFileReader.h"

#include <string>

class vtkStringArray;

namespace brainshift
{
class TextHeaderVolume;
}

class VTKBRAINSHIFTFILTERS_EXPORT vtkNRRDVolumeReader : public vtkVolumeFileReader
{
public:
  static vtkNRRDVolumeReader* New();
  vtkTypeMacro(vtkNRRDVolumeReader, vtkVolumeFileReader);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  int CanReadFile(VTK_FILEPATH const char* fileName) override;

  ///@{
  /**
   * The layer of a segmentation to read: one of GetLayerList, or its number, from 1. Default:
   * empty, the first layer; then a warning names the segments of the others. Files without layers
   * ignore it.
   */
  void SetLayer(const char* name);
  const char* GetLayer() const { return this->Layer.c_str(); }
  ///@}

  /**
   * The layers of a segmentation whose segments may overlap, each a number and the names of its
   * segments, such as "2: vessel, tumour". Empty if the file has no layers. They are known after
   * UpdateInformation.
   */
  vtkStringArray* GetLayerList();

protected:
  vtkNRRDVolumeReader();
  ~vtkNRRDVolumeReader() override;

private:
  vtkNRRDVolumeReader(const vtkNRRDVolumeReader&) = delete;
  void operator=(const vtkNRRDVolumeReader&) = delete;

  explicit vtkNRRDVolumeReader(brainshift::TextHeaderVolume* volume); // takes it

  brainshift::TextHeaderVolume* Volume; // the superclass owns it
  std::string Layer;
  vtkNew<vtkStringArray> LayerList;
};

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSlicerSceneReader
 * @brief   holds the name of a scene of 3D Slicer until Python has opened it
 *
 * A scene makes many sources, so no reader can output it. The window opens the file of this source
 * with `brainshift.open_scene` and deletes the source. Where there is no window, an error says what
 * to call. The output remains empty.
 */
#ifndef vtkSlicerSceneReader_h
#define vtkSlicerSceneReader_h

#include "vtkBrainShiftFormatsModule.h" // for the export macro
#include "vtkPolyDataAlgorithm.h"

#include <string>

class VTKBRAINSHIFTFORMATS_EXPORT vtkSlicerSceneReader : public vtkPolyDataAlgorithm
{
public:
  static vtkSlicerSceneReader* New();
  vtkTypeMacro(vtkSlicerSceneReader, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;
  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  ///@{
  /** The scene: .mrml or .mrb. Default: none, which is an error. */
  vtkSetMacro(FileName, std::string);
  vtkGetMacro(FileName, std::string);
  ///@}

  /** 1 if the file begins like a scene (.mrml) or is a zip file (.mrb). Else 0. */
  static int CanReadFile(const char* fileName);

protected:
  vtkSlicerSceneReader();
  ~vtkSlicerSceneReader() override = default;

  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkSlicerSceneReader(const vtkSlicerSceneReader&) = delete;
  void operator=(const vtkSlicerSceneReader&) = delete;

  std::string FileName;
};

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDisplacementFieldReader
 * @brief   reads the displacement fields of ANTs, elastix, NiftyReg, Slicer and BrainShift
 *
 * Formats: FieldFile.h. Output: an image with the vectors Displacement (float32 x 3, mm, world
 * axes) and a field array that names the direction (FieldDirection.h).
 */
#ifndef vtkDisplacementFieldReader_h
#define vtkDisplacementFieldReader_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro
#include "vtkImageAlgorithm.h"

#include <memory> // for the private part
#include <string>

class VTKBRAINSHIFTFILTERS_EXPORT vtkDisplacementFieldReader : public vtkImageAlgorithm
{
public:
  static vtkDisplacementFieldReader* New();
  vtkTypeMacro(vtkDisplacementFieldReader, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum WorldType
  {
    RAS = 0, // x to the right, y to the front: that of the NIFTI Volume Reader
    LPS = 1, // that of ITK, and of ParaView's own readers of ITK's files
  };

  enum DirectionType
  {
    AsTheFileTells = 0, // backward if it does not
    Forward = 1,
    Backward = 2,
  };

  ///@{
  /** The file: .nii, .nii.gz, .mha, .mhd, .nrrd or .nhdr. */
  vtkSetMacro(FileName, std::string);
  vtkGetMacro(FileName, std::string);
  ///@}

  ///@{
  /** Which world the volumes to bend lie in: RAS (default) or LPS. */
  vtkSetClampMacro(World, int, RAS, LPS);
  vtkGetMacro(World, int);
  ///@}

  ///@{
  /** Which way the field leads. Default: AsTheFileTells. */
  vtkSetClampMacro(Direction, int, AsTheFileTells, Backward);
  vtkGetMacro(Direction, int);
  ///@}

  /** 1 if the file is a displacement field. */
  static int CanReadFile(const char* fileName);

protected:
  vtkDisplacementFieldReader();
  ~vtkDisplacementFieldReader() override;

  int RequestInformation(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkDisplacementFieldReader(const vtkDisplacementFieldReader&) = delete;
  void operator=(const vtkDisplacementFieldReader&) = delete;

  std::string FileName;
  int World = RAS;
  int Direction = AsTheFileTells;
  struct State; // the field as read
  std::unique_ptr<State> Internal;
};

#endif

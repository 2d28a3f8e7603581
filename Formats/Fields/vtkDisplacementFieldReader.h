// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDisplacementFieldReader
 * @brief   reads the displacement fields of ANTs, elastix, NiftyReg, Slicer and BrainShift
 *
 * FieldFile.h lists the formats. Output: an image with the point array Displacement as its vectors
 * (float32 x 3, mm, world axes) and a field array that names the direction (FieldDirection.h).
 */
#ifndef vtkDisplacementFieldReader_h
#define vtkDisplacementFieldReader_h

#include "vtkBrainShiftFormatsModule.h" // for the export macro
#include "vtkImageAlgorithm.h"

#include <memory> // for the private part
#include <string>

class VTKBRAINSHIFTFORMATS_EXPORT vtkDisplacementFieldReader : public vtkImageAlgorithm
{
public:
  static vtkDisplacementFieldReader* New();
  vtkTypeMacro(vtkDisplacementFieldReader, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;
  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  enum WorldType
  {
    RAS = 0, ///< x to the right, y to the front: the world of NIFTI Volume Reader
    LPS = 1, ///< x to the left, y to the back: the world of ITK and of ParaView's own readers
  };

  enum DirectionType
  {
    AsTheFileTells = 0, ///< the direction that the file names; backward if it names none
    Forward = 1,
    Backward = 2,
  };

  ///@{
  /** The file: .nii, .nii.gz, .mha, .mhd, .nrrd or .nhdr. Default: none, which is an error. */
  vtkSetMacro(FileName, std::string);
  vtkGetMacro(FileName, std::string);
  ///@}

  ///@{
  /** The world in which the volumes to bend lie: RAS (default) or LPS. */
  vtkSetClampMacro(World, int, RAS, LPS);
  vtkGetMacro(World, int);
  ///@}

  ///@{
  /** The direction of the field. Default AsTheFileTells. */
  vtkSetClampMacro(Direction, int, AsTheFileTells, Backward);
  vtkGetMacro(Direction, int);
  ///@}

  /** Why the last run read no field: a sentence. Empty if it read one. */
  vtkGetMacro(Problem, std::string);

  /**
   * Points of the last field that have no finite number, such as "no finite number at 12 of 729
   * points, from 0 0 0 to 24 64 64 mm". No deformation can use them. Empty if all have one.
   */
  vtkGetMacro(Gap, std::string);

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
  std::string Problem = "Nothing was read";
  std::string Gap;
  int World = RAS;
  int Direction = AsTheFileTells;
  struct State; // the field as read
  std::unique_ptr<State> Internal;
};

#endif

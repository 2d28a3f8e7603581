// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDisplacementFieldWriter
 * @brief   writes a displacement field for registration programs
 *
 * Input: an image with displacements (mm, world axes), such as the output of Deformation Field. The
 * ending of the file's name chooses the format. FieldFile.h lists the formats and where each of
 * them names the direction. ITK expects fields that lead backward.
 *
 * ParaView chooses this writer for every image with an array of three components. An image whose
 * scalars are something else, such as intensities or colours, is written as the volume that it is.
 */
#ifndef vtkDisplacementFieldWriter_h
#define vtkDisplacementFieldWriter_h

#include "vtkBrainShiftFormatsModule.h" // for the export macro
#include "vtkWriter.h"

#include <string>

class vtkImageData;

class VTKBRAINSHIFTFORMATS_EXPORT vtkDisplacementFieldWriter : public vtkWriter
{
public:
  static vtkDisplacementFieldWriter* New();
  vtkTypeMacro(vtkDisplacementFieldWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;
  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  enum WorldType
  {
    RAS = 0, ///< x to the right, y to the front: the world of NIFTI Volume Reader
    LPS = 1, ///< x to the left, y to the back: the world of ITK and of ParaView's own readers
  };

  ///@{
  /** The file: .nii, .nii.gz, .mha, .mhd or .nrrd. Default: none, which is an error. */
  vtkSetMacro(FileName, std::string);
  vtkGetMacro(FileName, std::string);
  ///@}

  ///@{
  /** The world in which the input lies: RAS (default) or LPS. */
  vtkSetClampMacro(World, int, RAS, LPS);
  vtkGetMacro(World, int);
  ///@}

  /**
   * Why the last run wrote no file: one sentence, without a full stop. Empty if it wrote the file.
   * A file that was there before then stays as it was.
   */
  vtkGetMacro(Problem, std::string);

protected:
  vtkDisplacementFieldWriter() = default;
  ~vtkDisplacementFieldWriter() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  void WriteData() override;

private:
  vtkDisplacementFieldWriter(const vtkDisplacementFieldWriter&) = delete;
  void operator=(const vtkDisplacementFieldWriter&) = delete;

  void WriteImage();
  void WriteVolume(vtkImageData* image);

  std::string FileName;
  int World = RAS;
  std::string Problem = "Nothing was written";
};

#endif

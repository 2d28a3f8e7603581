// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDisplacementFieldWriter
 * @brief   writes a displacement field for registration programs
 *
 * Input: an image with displacements, such as Deformation Field's. Formats and how each names the
 * direction: FieldFile.h; the name's ending chooses. ITK takes fields that lead backward.
 */
#ifndef vtkDisplacementFieldWriter_h
#define vtkDisplacementFieldWriter_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro
#include "vtkWriter.h"

#include <string>

class VTKBRAINSHIFTFILTERS_EXPORT vtkDisplacementFieldWriter : public vtkWriter
{
public:
  static vtkDisplacementFieldWriter* New();
  vtkTypeMacro(vtkDisplacementFieldWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum WorldType
  {
    RAS = 0, // that of the NIFTI Volume Reader
    LPS = 1, // that of ITK, and of ParaView's own readers of ITK's files
  };

  ///@{
  /** The file: .nii, .nii.gz, .mha, .mhd or .nrrd. */
  vtkSetMacro(FileName, std::string);
  vtkGetMacro(FileName, std::string);
  ///@}

  ///@{
  /** Which world the input lies in: RAS (default) or LPS. */
  vtkSetClampMacro(World, int, RAS, LPS);
  vtkGetMacro(World, int);
  ///@}

protected:
  vtkDisplacementFieldWriter() = default;
  ~vtkDisplacementFieldWriter() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  void WriteData() override;

private:
  vtkDisplacementFieldWriter(const vtkDisplacementFieldWriter&) = delete;
  void operator=(const vtkDisplacementFieldWriter&) = delete;

  std::string FileName;
  int World = RAS;
};

#endif

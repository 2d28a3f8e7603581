// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkLandmarkWriter
 * @brief   writes landmarks and traced points for Slicer, MNI tools and tables
 *
 * Input: points in mm with point arrays as Landmark Reader makes them, all of them optional. Its
 * field array WorldAxes says whether they are RAS or LPS; without it they count as RAS. The ending
 * of the file's name chooses the format (LandmarkFile.h). The points may be at rest or moved by
 * Deform Geometry: the file does not say which.
 */
#ifndef vtkLandmarkWriter_h
#define vtkLandmarkWriter_h

#include "vtkBrainShiftFormatsModule.h" // for the export macro
#include "vtkWriter.h"

#include <string>

class VTKBRAINSHIFTFORMATS_EXPORT vtkLandmarkWriter : public vtkWriter
{
public:
  static vtkLandmarkWriter* New();
  vtkTypeMacro(vtkLandmarkWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;
  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  enum FileAxesType
  {
    OfTheFormat = 0, ///< LPS in .mrk.json and .fcsv, as Slicer writes them; RAS in .tag and tables
    RAS = 1,         ///< x to the right, y to the front, z to the head
    LPS = 2,         ///< x to the left, y to the back, z to the head; not in .tag
  };

  ///@{
  /** The file: .mrk.json, .json, .fcsv, .tag, .csv or .tsv. Default: none, which is an error. */
  vtkSetMacro(FileName, std::string);
  vtkGetMacro(FileName, std::string);
  ///@}

  ///@{
  /** The axes in the file, which names them. Default OfTheFormat. */
  vtkSetClampMacro(FileAxes, int, OfTheFormat, LPS);
  vtkGetMacro(FileAxes, int);
  ///@}

  /**
   * Why the last run wrote no file: one sentence, without a full stop. Empty if it wrote the file.
   * A file that was there before then stays as it was.
   */
  vtkGetMacro(Problem, std::string);

protected:
  vtkLandmarkWriter() = default;
  ~vtkLandmarkWriter() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  void WriteData() override;

private:
  vtkLandmarkWriter(const vtkLandmarkWriter&) = delete;
  void operator=(const vtkLandmarkWriter&) = delete;

  std::string FileName;
  int FileAxes = OfTheFormat;
  std::string Problem = "Nothing was written";
};

#endif

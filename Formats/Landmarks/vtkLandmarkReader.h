// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkLandmarkReader
 * @brief   reads landmarks and traced points of Slicer, MNI tools and tables into RAS millimetres
 *
 * LandmarkFile.h lists the formats. Output: vertices (double precision, mm, RAS) with those of
 * these point arrays for which the file says something: Label (string, UTF-8), Number (place in the
 * file, from 1 on; of a table its column), Time (in the unit of the file, which the array names)
 * and Deviation (mm). Numbers are double, and NaN where the file says none. The field array
 * WorldAxes says RAS. Trace Distance and Deform Geometry take it as it is. Points without a
 * position are left out with a warning. On several processes the first one has all points. After
 * an error the output is empty.
 */
#ifndef vtkLandmarkReader_h
#define vtkLandmarkReader_h

#include "vtkBrainShiftFormatsModule.h" // for the export macro
#include "vtkPolyDataAlgorithm.h"

#include <string>
#include <vector>

class VTKBRAINSHIFTFORMATS_EXPORT vtkLandmarkReader : public vtkPolyDataAlgorithm
{
public:
  static vtkLandmarkReader* New();
  vtkTypeMacro(vtkLandmarkReader, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;
  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  enum TableAxesType
  {
    RAS = 0, ///< x to the right, y to the front, z to the head
    LPS = 1, ///< x to the left, y to the back, z to the head
  };

  ///@{
  /** The file: .mrk.json, .json, .fcsv, .tag, .csv or .tsv. Default: none, which is an error. */
  vtkSetMacro(FileName, std::string);
  vtkGetMacro(FileName, std::string);
  ///@}

  ///@{
  /**
   * The volume of a .tag file whose points are read: 1 or 2. Default: 0, which reads those of the
   * first, with a warning if there are two.
   */
  vtkSetClampMacro(Volume, int, 0, 2);
  vtkGetMacro(Volume, int);
  ///@}

  ///@{
  /** The axes of a table whose columns are called x, y and z: RAS (default) or LPS. */
  vtkSetClampMacro(TableAxes, int, RAS, LPS);
  vtkGetMacro(TableAxes, int);
  ///@}

  ///@{
  /**
   * Names of the three columns of a table that hold the position, in the order x, y, z. Axes,
   * units and signs in these names count. Default: none, so that what the columns are called
   * decides.
   */
  void AddPositionColumn(const char* name);
  void ClearPositionColumns();
  ///@}

  /** Why the last run read no points: one sentence, without a full stop. Empty if it read them. */
  vtkGetMacro(Problem, std::string);

  /** 1 if the file begins like one of the formats; a table must name its columns. Else 0. */
  static int CanReadFile(const char* fileName);

protected:
  vtkLandmarkReader();
  ~vtkLandmarkReader() override = default;

  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkLandmarkReader(const vtkLandmarkReader&) = delete;
  void operator=(const vtkLandmarkReader&) = delete;

  std::string FileName;
  int Volume = 0;
  int TableAxes = RAS;
  std::vector<std::string> PositionColumns;
  std::string Problem = "Nothing was read";
};

#endif

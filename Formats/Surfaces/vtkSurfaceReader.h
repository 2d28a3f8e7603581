// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSurfaceReader
 * @brief   reads surfaces of FreeSurfer and GIFTI into RAS millimetres
 *
 * Files: FreeSurfer's triangles, such as lh.pial, and GIFTI (.gii, .surf.gii).
 *
 * FreeSurfer keeps points in tkRAS. The geometry of the volume, which most files name, takes them
 * to the scanner's RAS. Volume or VolumeCenter stand in for files that do not name it. Without
 * either, the surface stays in tkRAS and a warning says so. In GIFTI files a matrix may lead to the
 * scanner's RAS; GIFTISurface.cxx has the rule.
 *
 * Output: triangles (double precision points, mm, RAS) with the file's numbers as point arrays,
 * under their names, and the names of labels (LabelTable.h). The field array WorldAxes says RAS if
 * the file or Volume says where the surface lies. On several processes the first one has all
 * triangles. After an error the output is empty.
 */
#ifndef vtkSurfaceReader_h
#define vtkSurfaceReader_h

#include "vtkBrainShiftFormatsModule.h" // for the export macro
#include "vtkPolyDataAlgorithm.h"

#include <string>
#include <vector>

class VTKBRAINSHIFTFORMATS_EXPORT vtkSurfaceReader : public vtkPolyDataAlgorithm
{
public:
  static vtkSurfaceReader* New();
  vtkTypeMacro(vtkSurfaceReader, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;
  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  ///@{
  /** The file of points and triangles. Default: none, which is an error. */
  vtkSetMacro(FileName, std::string);
  vtkGetMacro(FileName, std::string);
  ///@}

  ///@{
  /** Files of numbers of the points: lh.thickness and its like, and GIFTI. Default: none. */
  void AddValueFileName(const char* fileName);
  void ClearValueFileNames();
  ///@}

  ///@{
  /**
   * The volume from which FreeSurfer made the surface: orig.mgz or T1.mgz of the subject's folder
   * (.mgz, .mgh or NIfTI), not the scan, whose axes would mirror the surface. Only files that do
   * not name its geometry need it. Default: none.
   */
  vtkSetMacro(Volume, std::string);
  vtkGetMacro(Volume, std::string);
  ///@}

  ///@{
  /**
   * Where there is no Volume: the middle of a conformed volume, c_ras of mri_info (mm, scanner
   * RAS). Default 0 0 0, which stands for none.
   */
  vtkSetVector3Macro(VolumeCenter, double);
  vtkGetVector3Macro(VolumeCenter, double);
  ///@}

  /** 1 if the file begins like one of the formats, else 0. */
  static int CanReadFile(const char* fileName);

protected:
  vtkSurfaceReader();
  ~vtkSurfaceReader() override = default;

  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkSurfaceReader(const vtkSurfaceReader&) = delete;
  void operator=(const vtkSurfaceReader&) = delete;

  std::string FileName;
  std::vector<std::string> ValueFileNames;
  std::string Volume;
  double VolumeCenter[3] = { 0.0, 0.0, 0.0 };
};

#endif

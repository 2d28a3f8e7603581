// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTractWriter
 * @brief   writes streamlines for TrackVis, MRtrix and TRX
 *
 * Input: lines in mm with point and cell arrays as Tract Reader makes them, at rest or moved by
 * Deform Geometry: the file does not say which. The field array WorldAxes says whether they are RAS
 * or LPS; without it they count as RAS, with a warning. The ending of the file's name chooses the
 * format. TRX keeps all numbers and groups, TrackVis up to 10 arrays of each kind as float32,
 * MRtrix none; a warning names what is left out.
 */
#ifndef vtkTractWriter_h
#define vtkTractWriter_h

#include "vtkBrainShiftFormatsModule.h" // for the export macro
#include "vtkWriter.h"

#include <string>

class VTKBRAINSHIFTFORMATS_EXPORT vtkTractWriter : public vtkWriter
{
public:
  static vtkTractWriter* New();
  vtkTypeMacro(vtkTractWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;
  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  ///@{
  /** The file: .trk, .tck or .trx. Default: none, which is an error. */
  vtkSetMacro(FileName, std::string);
  vtkGetMacro(FileName, std::string);
  ///@}

  ///@{
  /**
   * The volume whose voxels .trk and .trx name: .mgz, .mgh or NIfTI. Points stay where they are.
   * Default: none, which stands for a box of voxels of 1 mm around the points.
   */
  vtkSetMacro(Volume, std::string);
  vtkGetMacro(Volume, std::string);
  ///@}

  /**
   * Why the last run wrote no file: one sentence, without a full stop. Empty if it wrote the file.
   * A file that was there before then stays as it was.
   */
  vtkGetMacro(Problem, std::string);

protected:
  vtkTractWriter() = default;
  ~vtkTractWriter() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  void WriteData() override;

private:
  vtkTractWriter(const vtkTractWriter&) = delete;
  void operator=(const vtkTractWriter&) = delete;

  std::string FileName;
  std::string Volume;
  std::string Problem = "Nothing was written";
};

#endif

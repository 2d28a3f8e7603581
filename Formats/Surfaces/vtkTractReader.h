// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTractReader
 * @brief   reads streamlines of TrackVis, MRtrix and TRX into RAS millimetres
 *
 * Files: TrackVis (.trk), MRtrix (.tck), both also packed (.gz), and TRX (.trx, or a folder).
 * TrackVis keeps points in mm from the corner of a
 * volume; vox_to_ras of the header takes them to RAS. MRtrix keeps them in RAS.
 *
 * Output: one line for each streamline (single precision points, mm, RAS). Scalars of TrackVis are
 * point arrays and its properties are cell arrays (float32), under their names; those of TRX keep
 * their types, and a group NAME is the cell array groups/NAME (1: in it). The field array
 * WorldAxes says RAS if the file or Volume says where the streamlines lie. The reader reports
 * progress and can be aborted. On several processes the first one has all lines. After an error the
 * output is empty.
 */
#ifndef vtkTractReader_h
#define vtkTractReader_h

#include "vtkBrainShiftFormatsModule.h" // for the export macro
#include "vtkPolyDataAlgorithm.h"

#include <string>

class VTKBRAINSHIFTFORMATS_EXPORT vtkTractReader : public vtkPolyDataAlgorithm
{
public:
  static vtkTractReader* New();
  vtkTypeMacro(vtkTractReader, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;
  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  ///@{
  /** The file: .trk, .tck, .trk.gz, .tck.gz or .trx. Default: none, which is an error. */
  vtkSetMacro(FileName, std::string);
  vtkGetMacro(FileName, std::string);
  ///@}

  ///@{
  /**
   * The volume in whose voxels the streamlines were made: .mgz, .mgh or NIfTI. Only files of
   * TrackVis without vox_to_ras need it. Default: none.
   */
  vtkSetMacro(Volume, std::string);
  vtkGetMacro(Volume, std::string);
  ///@}

  /** 1 if the file begins like one of the formats, else 0. */
  static int CanReadFile(const char* fileName);

protected:
  vtkTractReader();
  ~vtkTractReader() override = default;

  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkTractReader(const vtkTractReader&) = delete;
  void operator=(const vtkTractReader&) = delete;

  std::string FileName;
  std::string Volume;
};

#endif

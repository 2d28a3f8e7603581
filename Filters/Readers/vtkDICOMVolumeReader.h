// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDICOMVolumeReader
 * @brief   reads a DICOM series into RAS millimetres
 *
 * FileName names a folder, any of its files, or a DICOMDIR. Files: slices, and multi-frame MR, CT
 * and PET; packed or not. vtkVolumeFileReader says what the output is.
 *
 * A series is what can be one volume: images of one SeriesInstanceUID, orientation, size and type.
 * Slices are sorted by position, and the spacing comes from positions. A tilted gantry is told, as
 * are uneven, missing and duplicate slices. Images at one position become time steps. The rescale
 * slope and intercept are applied. Colours and MONOCHROME1 are refused. The patient's name and
 * number are not read.
 */
#ifndef vtkDICOMVolumeReader_h
#define vtkDICOMVolumeReader_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro
#include "vtkNew.h"
#include "vtkVolumeFileReader.h"

#include <string>

class vtkStringArray;

namespace brainshift
{
class DICOMVolume;
}

class VTKBRAINSHIFTFILTERS_EXPORT vtkDICOMVolumeReader : public vtkVolumeFileReader
{
public:
  static vtkDICOMVolumeReader* New();
  vtkTypeMacro(vtkDICOMVolumeReader, vtkVolumeFileReader);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  int CanReadFile(VTK_FILEPATH const char* fileName) override;

  ///@{
  /**
   * The series to read: one of GetSeriesList. Default: empty, the series of the file; of a folder,
   * the one with the most voxels.
   */
  void SetSeries(const char* name);
  const char* GetSeries() const { return this->Series.c_str(); }
  ///@}

  /** Path of the first image of the series; empty before its header is read. */
  std::string GetShownFile() const;

  /**
   * The series of the folder by number, description, modality, size and date. They are known after
   * UpdateInformation. The first is shown by default.
   */
  vtkStringArray* GetSeriesList();

  ///@{
  /**
   * Whether slices that are not evenly spaced, or that a tilted gantry shifts against each other,
   * are interpolated on an upright grid. If not, a warning names the largest error in mm. Default:
   * false.
   */
  void SetResampleSlices(bool resample);
  vtkGetMacro(ResampleSlices, bool);
  vtkBooleanMacro(ResampleSlices, bool);
  ///@}

protected:
  vtkDICOMVolumeReader();
  ~vtkDICOMVolumeReader() override;

private:
  vtkDICOMVolumeReader(const vtkDICOMVolumeReader&) = delete;
  void operator=(const vtkDICOMVolumeReader&) = delete;

  explicit vtkDICOMVolumeReader(brainshift::DICOMVolume* volume); // takes it

  brainshift::DICOMVolume* Volume; // the superclass owns it
  std::string Series;
  bool ResampleSlices = false;
  vtkNew<vtkStringArray> SeriesList;
};

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkVolumeFileWriter
 * @brief   writes a volume into one file, with its place, its axes and its type of numbers
 *
 * The ending of the file's name chooses the format: .nii, .nii.gz, .mha, .mhd or .nrrd.
 * WrittenVolume.h says how each names the axes. Whole numbers of 8 bytes become those of 4. A name
 * that ends in .dcm, or any name with Like, is that of a folder for a DICOM series.
 *
 * Input: an image whose point array is written. Its field array WorldAxes (WorldAxes.h) says which
 * way the world lies; the property World overrules it. An image that does not know is written as if
 * its world were RAS, with a warning. Warnings say what the file does not hold: other times of the
 * input, and names of labels.
 *
 * A large image is asked for in layers, one part after the other. A DICOM series, a NIfTI file of
 * several components, and several MPI ranks get all of it at once; the first rank writes it.
 */
#ifndef vtkVolumeFileWriter_h
#define vtkVolumeFileWriter_h

#include "vtkBrainShiftFormatsModule.h" // for the export macro
#include "vtkWriter.h"

#include <array>
#include <string>
#include <vector>

namespace brainshift
{
struct OutgoingVolume;
}

class VTKBRAINSHIFTFORMATS_EXPORT vtkVolumeFileWriter : public vtkWriter
{
public:
  static vtkVolumeFileWriter* New();
  vtkTypeMacro(vtkVolumeFileWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;
  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int ModifyRequest(vtkInformation* request, int when) override;

  enum WorldType
  {
    AsTheVolumeSays = 0, ///< the field array WorldAxes; RAS, with a warning, if there is none
    RAS = 1,             ///< x to the right, y to the front
    LPS = 2,             ///< x to the left, y to the back
  };

  ///@{
  /** The file to write. Default: none, which is an error. */
  vtkSetMacro(FileName, std::string);
  vtkGetMacro(FileName, std::string);
  ///@}

  ///@{
  /**
   * A DICOM file of the patient's scan, or a folder with one: a DICOM series takes its patient,
   * study, frame of reference and modality. Default: none, for other formats.
   */
  vtkSetMacro(Like, std::string);
  vtkGetMacro(Like, std::string);
  ///@}

  ///@{
  /** The point array to write. Default: none, which takes the active scalars. */
  vtkSetMacro(PointArray, std::string);
  vtkGetMacro(PointArray, std::string);
  ///@}

  ///@{
  /** The world in which the input lies: AsTheVolumeSays (default), RAS or LPS. */
  vtkSetClampMacro(World, int, AsTheVolumeSays, LPS);
  vtkGetMacro(World, int);
  ///@}

  ///@{
  /**
   * An image of more MiB is asked for in layers of so many MiB, at least one layer. Default: 512.
   */
  vtkSetClampMacro(MemoryLimit, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(MemoryLimit, double);
  ///@}

  /**
   * Why the last run wrote no file: one sentence, without a full stop. Empty if it wrote the file.
   * A file that was there before then stays as it was.
   */
  vtkGetMacro(Problem, std::string);

protected:
  vtkVolumeFileWriter() = default;
  ~vtkVolumeFileWriter() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  void WriteData() override;

private:
  vtkVolumeFileWriter(const vtkVolumeFileWriter&) = delete;
  void operator=(const vtkVolumeFileWriter&) = delete;

  void WriteImage();
  bool IsInLayers();
  std::vector<std::array<int, 6>> Layers();
  brainshift::OutgoingVolume TakeLayers(const std::array<int, 6>& extent);

  std::string FileName;
  std::string Like;
  std::string PointArray;
  int World = AsTheVolumeSays;
  double MemoryLimit = 512.0; // MiB
  std::string Problem = "Nothing was written";
};

#endif

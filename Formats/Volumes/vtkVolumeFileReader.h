// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkVolumeFileReader
 * @brief   reads volumes of all registered formats into RAS millimetres
 *
 * World is RAS: x to the patient's right, y to the front, z to the head. The first of volumeFormats
 * (VolumeFile.h) that recognises the file reads it. Each format has a proxy of its own, which sets
 * Format, so that File > Open offers it by its ending.
 *
 * Voxels are permuted and flipped, never resampled, so that the axes of the image run along the
 * nearest RAS axes. The rotation that is left (an oblique scan) becomes the direction matrix of the
 * image. For scans along the axes that matrix is exactly the identity, so filters that ignore
 * directions are right too. No image can hold sheared axes: they give a warning that names the
 * error in mm.
 *
 * Output: vtkImageData with the point scalars "Intensity" (ArrayName). Their type is the type in
 * the file. If the file rescales them it is float32, or double for whole numbers of 4 bytes and
 * more. A time series has time steps, in seconds. The field array WorldAxes says RAS if the file
 * knows the patient's sides (WorldAxes.h). Names and colours of labels are attached where the file
 * has them (LabelTable.h). The field array Unit (string) is the unit of the numbers, SmallIsBright
 * (one byte) says that stations show small numbers bright; both only where the file says so. After
 * an error the output stays as it was, or is empty.
 *
 * Reading can be aborted. Then the output is the volume that was last read to its end, or empty, a
 * warning says so, and nothing is read again before the reader is modified.
 */
#ifndef vtkVolumeFileReader_h
#define vtkVolumeFileReader_h

#include "vtkBrainShiftFormatsModule.h" // for the export macro
#include "vtkImageAlgorithm.h"
#include "vtkNew.h" // for the private part
#include "vtkSmartPointer.h"

#include <functional> // for the private part
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace brainshift
{
class PlacedVolume;
class VolumeFile;
struct VolumeFormat;
}

class vtkImageData;
class vtkStringArray;

class VTKBRAINSHIFTFORMATS_EXPORT vtkVolumeFileReader : public vtkImageAlgorithm
{
public:
  static vtkVolumeFileReader* New();
  vtkTypeMacro(vtkVolumeFileReader, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;
  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  ///@{
  /** The file to read. Default: none, which is an error. */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /** The name of the only format that is tried, such as "NRRD". Default: empty, all of them. */
  void SetFormat(const char* name);
  const char* GetFormat() const { return this->Format.c_str(); }
  ///@}

  ///@{
  /**
   * Which volume of a file with several to read: the series of a DICOM folder or the layer of a
   * segmentation, one of GetChoiceList, which is filled when the header is read. Default: empty,
   * the first.
   */
  void SetChoice(const char* name);
  const char* GetChoice() const { return this->Choice.c_str(); }
  vtkStringArray* GetChoiceList();
  ///@}

  ///@{
  /**
   * When slices of a DICOM series that are not evenly spaced, or that a tilted gantry shifts, are
   * interpolated on an upright grid: 0 never, 1 always, 2 where slices would be shown half a voxel
   * or more from their position. Default: 2. A warning says what was done, with the error in mm.
   */
  void SetResampleSlices(int resample);
  int GetResampleSlices() const { return this->ResampleSlices; }
  ///@}

  ///@{
  /**
   * Whether colours of a DICOM series become one number, their brightness (0.299 red + 0.587 green
   * + 0.114 blue). Default: false, three components.
   */
  void SetLuminance(bool luminance);
  bool GetLuminance() const { return this->Luminance; }
  ///@}

  ///@{
  /** Name of the array of the voxels. Default: empty, which is Intensity. */
  void SetArrayName(const char* name);
  const char* GetArrayName() const { return this->ArrayName.c_str(); }
  ///@}

  ///@{
  /**
   * Which resolution (level) of a file with several to read: 0 is the finest, -1 the finest whose
   * numbers fit MemoryLimit. Default: -1.
   */
  void SetLevel(int level);
  int GetLevel() const { return this->Level; }
  ///@}

  ///@{
  /**
   * The most MiB that the numbers of one time step may take if Level is -1, at least 0. Where no
   * level fits, the coarsest is read. Default: 2048.
   */
  void SetMemoryLimit(double mebibytes);
  double GetMemoryLimit() const { return this->MemoryLimit; }
  ///@}

  ///@{
  /** Which channel of an image to read: from 0 on, or -1, all as components. Default: -1. */
  void SetChannel(int channel);
  int GetChannel() const { return this->Channel; }
  ///@}

  ///@{
  /**
   * The rows of an affine map from the RAS of the file to the world, mm: moves the volume without
   * resampling it. Its last row is 0 0 0 1. Default: the identity.
   */
  vtkSetVectorMacro(WorldFromFile, double, 16);
  vtkGetVectorMacro(WorldFromFile, double, 16);
  ///@}

  /** What was chosen of the file, and why: a sentence. Empty if the format chooses nothing. */
  std::string GetNote() const;

  /** Why the last run read no volume: a sentence. Empty if it read one. */
  std::string GetProblem() const { return this->Problem; }

  /** Path of the first file of the volume that is shown; empty if there is none. */
  std::string GetShownFile() const;

  /** Whether the reader reads a header or voxels at this moment. */
  bool GetIsReading() const { return this->IsReading; }

  /** 1 if the file exists and begins like a file of Format, else 0. */
  int CanReadFile(VTK_FILEPATH const char* fileName);

protected:
  vtkVolumeFileReader();
  ~vtkVolumeFileReader() override;

  int RequestInformation(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkVolumeFileReader(const vtkVolumeFileReader&) = delete;
  void operator=(const vtkVolumeFileReader&) = delete;

  // Calls `step`, and keeps the sentence that it throws.
  int keepingProblem(const std::function<int()>& step);
  // Reads the header of the file and announces it.
  int readHeader(vtkInformation* output);
  // Finds the format of the file, or throws one sentence.
  void takeFormat();
  // Calls `read`. IsReading holds meanwhile.
  void reading(const std::function<void()>& read);
  // Fills the output with the volume of the time that is asked for.
  int readVolume(vtkInformation* output);
  // Says on several MPI ranks that each of them reads more than its part.
  void warnOfRanks(vtkInformation* output);
  // Tells the pipeline what was last read to its end.
  void announceLast(vtkInformation* output);
  // Keeps what is read; keepLast shows it again, after the user stopped the next one.
  void rememberLast(vtkInformation* output);
  void keepLast(vtkInformation* output);

  // The volume that was last read to its end, and what was announced of it.
  struct Shown
  {
    vtkSmartPointer<vtkImageData> image; // null: none
    int wholeExtent[6] = { 0, -1, 0, -1, 0, -1 };
    std::vector<double> times;
    bool isOfHeader = false; // of the header that was read last
  };

  char* FileName = nullptr;
  std::string Format;
  std::string Choice;
  std::string Problem = "Nothing was read";
  vtkNew<vtkStringArray> ChoiceList;
  int ResampleSlices = 2;
  double WorldFromFile[16] = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };
  bool Luminance = false;
  std::string ArrayName;
  int Level = -1;
  double MemoryLimit = 2048.0; // MiB
  int Channel = -1;
  Shown Last;
  bool IsReading = false;
  std::set<std::string> Warned; // warnings on voxels, each once for a header that is read
  bool IsStopped = false;       // the header that was read last is not what is shown
  const brainshift::VolumeFormat* Taken = nullptr; // of File
  brainshift::VolumeFile* File = nullptr;          // held by Stored; null: no format yet
  std::unique_ptr<brainshift::PlacedVolume> Stored;
};

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief The voxels of a NIfTI file and where they lie in RAS millimetres.
 *
 * Voxels are permuted and flipped, never resampled, so that the axes of the image run along the
 * nearest RAS axes (NIFTIGeometry.h). Numbers keep the file's type. They become float32 if
 * scl_slope and scl_inter rescale them; a slope of 0 or NaN does not, and colours never are.
 */
#ifndef BrainShift_NIFTIVolume_h
#define BrainShift_NIFTIVolume_h

#include "Filters/Files/NIFTIGeometry.h"

#include "vtkCallbackCommand.h" // for its smart pointer
#include "vtkNIFTIImageReader.h"
#include "vtkNew.h"

#include <cstddef>
#include <string>
#include <vector>

class vtkImageData;

namespace brainshift
{
/** Reads one file at a time: first its header, then its voxels. */
class NIFTIVolume
{
public:
  NIFTIVolume();

  /**
   * Reads the header of a file. Returns one sentence, without a full stop, on why the file cannot
   * be read; empty if it can.
   */
  std::string readHeader(const std::string& fileName);

  /** Whether the last header was good. All that follows is of that file. */
  bool isPlaced() const { return this->Placed; }

  /**
   * One sentence, without a full stop, if the file is sheared by more than LargestUnreportedShear,
   * which no image can hold; else empty.
   */
  std::string shearWarning() const;

  /**
   * Whether the file says where the sides of the patient are: by an sform or a qform. Without both
   * the axes of the voxels stand for right, anterior and superior, which may be wrong.
   */
  bool knowsSides() const { return this->KnowsSides; }

  /** Where the voxels lie. */
  const NIFTIGrid& geometry() const { return this->Geometry; }

  /** Times (s) of the volumes; at least one. */
  const std::vector<double>& times() const { return this->Times; }

  /** Numbers at each voxel of one volume. */
  int components() const;

  /** VTK's number of the type that the voxels are handed out in. */
  int scalarType() const;

  /**
   * Reads the voxels and makes room for them in `image`, over `extent`. Returns one sentence,
   * without a full stop, on why it cannot; empty if it can.
   */
  std::string load(vtkImageData* image, const int extent[6]);

  /**
   * Fills an image for which load made room with one volume of the file; `volume` is an index of
   * times(). The file's voxels stay in memory only if there are several volumes.
   */
  void fill(vtkImageData* image, std::size_t volume);

private:
  // value = slope * stored + intercept
  struct Rescaling
  {
    bool needed = false;
    double slope = 1.0;
    double intercept = 0.0;
  };
  // Why there is too little memory for the voxels; empty if there is enough.
  std::string memoryProblem(const int extent[6]) const;
  static Rescaling rescalingOf(vtkNIFTIImageHeader* header);

  std::string FileName;
  bool Placed = false;
  bool KnowsSides = false;
  std::string Error; // of Voxels
  vtkNew<vtkCallbackCommand> KeepError;
  vtkNew<vtkNIFTIImageReader> Voxels; // all volumes of a time series as components
  NIFTIGrid Geometry;
  Rescaling Rescale;
  std::vector<double> Times;
};
}

#endif

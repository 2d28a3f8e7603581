// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkBakeDeformation
 * @brief   resamples a deformable volume into an ordinary image, bent
 *
 * Output: an image on the same grid as the input, every point- and cell-data array resampled
 * through the same offset field that "Deformed Volume" draws with. Where the tissue seen lies
 * outside the volume, the voxel takes the array's lowest value. Integer arrays are rounded.
 * Runs on all cores; reports progress and can be aborted.
 */
#ifndef vtkBakeDeformation_h
#define vtkBakeDeformation_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro
#include "vtkImageAlgorithm.h"

class VTKBRAINSHIFTFILTERS_EXPORT vtkBakeDeformation : public vtkImageAlgorithm
{
public:
  static vtkBakeDeformation* New();
  vtkTypeMacro(vtkBakeDeformation, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum InterpolationType
  {
    Nearest = 0, // for labels
    Linear = 1,
    Cubic = 2, // Catmull-Rom over 64 voxels
  };

  ///@{
  /** How voxels are read: Nearest, Linear (default) or Cubic. */
  vtkSetClampMacro(Interpolation, int, Nearest, Cubic);
  vtkGetMacro(Interpolation, int);
  ///@}

protected:
  vtkBakeDeformation() = default;
  ~vtkBakeDeformation() override = default;

  int RequestUpdateExtent(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkBakeDeformation(const vtkBakeDeformation&) = delete;
  void operator=(const vtkBakeDeformation&) = delete;

  int Interpolation = Linear;
};

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkBakeDeformation
 * @brief   resamples a deformable volume into an ordinary image, bent
 *
 * Input: a deformable volume, the output of Free-Form Deformation. Output: an image on the grid of
 * the input. Every numeric point and cell array is resampled through restFromDeformed. It is found
 * for each voxel to 0.0001 lattice cells, whatever the number of samples. A voxel whose tissue
 * would come from outside the volume takes the array's lowest value. Values of integer arrays are
 * rounded.
 *
 * The filter runs on all cores, reports progress and can be aborted.
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
  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  enum InterpolationType
  {
    Nearest = 0, ///< for labels
    Linear = 1,  ///< trilinear
    Cubic = 2,   ///< Catmull-Rom over 64 voxels
  };

  ///@{
  /** How voxels are read: Nearest, Linear (default) or Cubic. */
  vtkSetClampMacro(Interpolation, int, Nearest, Cubic);
  vtkGetMacro(Interpolation, int);
  ///@}

protected:
  vtkBakeDeformation() = default;
  ~vtkBakeDeformation() override = default;

  int RequestInformation(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
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

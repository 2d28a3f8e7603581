// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkBakeDeformation
 * @brief   resamples a deformable volume into an ordinary image, bent
 *
 * Input: a deformable volume, the output of Free-Form Deformation. Output: an image on the grid of
 * the input. Every numeric point and cell array is resampled through restFromDeformed. It is found
 * for each voxel to 0.0001 lattice cells, whatever the number of samples. A voxel whose tissue
 * would come from outside the volume takes the lowest value of the whole array. Values of integer
 * arrays are rounded.
 *
 * Asked for a part, the filter asks for the parts of its input where the tissue of that part rests,
 * one after the other. Each number is the same as if all were asked for.
 *
 * The filter runs on all cores, reports progress and can be aborted.
 */
#ifndef vtkBakeDeformation_h
#define vtkBakeDeformation_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro
#include "vtkImageAlgorithm.h"

#include <memory> // for std::unique_ptr

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

  ///@{
  /**
   * If the input takes more MiB, and not all is asked for, parts of it are held one after the
   * other: at most two at once, each of half of it, or what 24 x 24 x 24 voxels need. A piece of
   * several, as on MPI ranks, gets all it needs at once. Default: 512.
   */
  vtkSetClampMacro(MemoryLimit, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(MemoryLimit, double);
  ///@}

protected:
  vtkBakeDeformation();
  ~vtkBakeDeformation() override;

  int RequestInformation(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestUpdateExtent(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkBakeDeformation(const vtkBakeDeformation&) = delete;
  void operator=(const vtkBakeDeformation&) = delete;

  struct State;
  struct Work;

  void Prepare(Work& work);
  void BakeBlock(Work& work, std::size_t number);
  void FindLowest(Work& work);

  int Interpolation = Linear;
  double MemoryLimit = 512.0; // MiB
  std::unique_ptr<State> Internal;
};

#endif

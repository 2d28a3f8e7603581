// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDeformationLattice
 * @brief   the control points of a deformable volume as an image
 *
 * Input: a deformable volume, the output of Free-Form Deformation. Output: an image whose points
 * are the control points. It has the point array Displacement (float32 x 3, mm, world axes;
 * Strength is applied) and the field arrays FFDKernel and FFDSamples. With the kernel B-spline
 * these are its numbers, no displacements of tissue. A mask is not in them: the field array
 * DrawnWith (BaseLattice.h) lets Free-Form Deformation warn if it has another one.
 *
 * Save it as .vti, and give it to Free-Form Deformation as Lattice with the LatticeDimensions, the
 * kernel and the mask of the first one: this restores the deformation.
 */
#ifndef vtkDeformationLattice_h
#define vtkDeformationLattice_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro
#include "vtkImageAlgorithm.h"

class VTKBRAINSHIFTFILTERS_EXPORT vtkDeformationLattice : public vtkImageAlgorithm
{
public:
  static vtkDeformationLattice* New();
  vtkTypeMacro(vtkDeformationLattice, vtkImageAlgorithm);
  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

protected:
  vtkDeformationLattice() = default;
  ~vtkDeformationLattice() override = default;

  int RequestInformation(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestUpdateExtent(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkDeformationLattice(const vtkDeformationLattice&) = delete;
  void operator=(const vtkDeformationLattice&) = delete;
};

#endif

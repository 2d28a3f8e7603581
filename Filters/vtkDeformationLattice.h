// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDeformationLattice
 * @brief   the control points of a deformable volume as an image
 *
 * Output: an image of the control points with their displacements as drawn (Displacement, float32
 * x 3, mm, world axes; Strength applied) and the field arrays FFDKernel and FFDSamples. Saved as
 * .vti and given to Free-Form Deformation as Lattice, with the same LatticeDimensions and kernel,
 * it is the same deformation.
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

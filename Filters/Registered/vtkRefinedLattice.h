// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkRefinedLattice
 * @brief   holds the control points of a refinement
 *
 * Output: a lattice over the box of the input, an image with the point array Displacement (float32
 * x 3, mm, world axes, forward), to be the Lattice of a Free-Form Deformation with the same
 * LatticeDimensions and Kernel. Of the settings of a lattice only LatticeDimensions count.
 * The numbers are a property, so that a state file restores the result without running the
 * refinement again.
 */
#ifndef vtkRefinedLattice_h
#define vtkRefinedLattice_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro
#include "vtkLatticeAlgorithm.h"

#include <vector>

class VTKBRAINSHIFTFILTERS_EXPORT vtkRefinedLattice : public vtkLatticeAlgorithm
{
public:
  static vtkRefinedLattice* New();
  vtkTypeMacro(vtkRefinedLattice, vtkLatticeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;
  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  ///@{
  /**
   * Displacements of the control points: 3 numbers each (mm, world axes), x fastest. Default: none,
   * which means that all are 0. Any other number of them is an error.
   */
  void AddControlPoint(double x, double y, double z);
  void ClearControlPoints();
  ///@}

protected:
  vtkRefinedLattice();
  ~vtkRefinedLattice() override = default;

  int RequestInformation(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestUpdateExtent(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkRefinedLattice(const vtkRefinedLattice&) = delete;
  void operator=(const vtkRefinedLattice&) = delete;

  std::vector<double> ControlPoints;
};

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkInvertDisplacementField
 * @brief   makes the forward field of a backward one, and the other way round
 *
 * Registration programs write fields that lead backward. A base lattice leads forward.
 *
 * Input: an image with displacements (mm, world axes). They are trilinear between the points;
 * outside, the displacement of the nearest point holds. Output: an image with the same points and
 * the displacements that undo those of the input. They are exact to 0.05 mm wherever the field does
 * not fold. Where it folds, they are the best that the solver finds. Between its points the output
 * is trilinear again, so it is less exact where the field changes much over a cell.
 *
 * A field that does not name its direction counts as backward.
 */
#ifndef vtkInvertDisplacementField_h
#define vtkInvertDisplacementField_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro
#include "vtkImageAlgorithm.h"

#include <limits>

class VTKBRAINSHIFTFILTERS_EXPORT vtkInvertDisplacementField : public vtkImageAlgorithm
{
public:
  static vtkInvertDisplacementField* New();
  vtkTypeMacro(vtkInvertDisplacementField, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;
  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  /**
   * Largest distance (mm) between a point and where the output and then the input take it. If it is
   * above 0.05 mm, the field folds somewhere, and a warning says so. NaN if the last execution
   * failed, and before the first one.
   */
  vtkGetMacro(LargestError, double);

protected:
  vtkInvertDisplacementField() = default;
  ~vtkInvertDisplacementField() override = default;

  int RequestInformation(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestUpdateExtent(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkInvertDisplacementField(const vtkInvertDisplacementField&) = delete;
  void operator=(const vtkInvertDisplacementField&) = delete;

  double LargestError = std::numeric_limits<double>::quiet_NaN();
};

#endif

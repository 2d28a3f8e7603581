// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkInvertDisplacementField
 * @brief   makes the forward field of a backward one, and the other way round
 *
 * Registration programs write fields that lead backward; a base lattice leads forward. Input: an
 * image with displacements (mm, world axes), trilinear between its points, the nearest one's
 * outside. Output: on the same points, the displacements that undo them, to 0.05 mm wherever the
 * field does not fold; where it does, the nearest the solver comes. Between the points the output
 * is trilinear again, which is as exact as the field is smooth over a cell.
 */
#ifndef vtkInvertDisplacementField_h
#define vtkInvertDisplacementField_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro
#include "vtkImageAlgorithm.h"

class VTKBRAINSHIFTFILTERS_EXPORT vtkInvertDisplacementField : public vtkImageAlgorithm
{
public:
  static vtkInvertDisplacementField* New();
  vtkTypeMacro(vtkInvertDisplacementField, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Largest distance (mm) of a point from where the output and then the input lead it. Above
   * 0.05 mm the field folds somewhere, and a warning tells.
   */
  vtkGetMacro(LargestError, double);

protected:
  vtkInvertDisplacementField() = default;
  ~vtkInvertDisplacementField() override = default;

  int RequestUpdateExtent(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkInvertDisplacementField(const vtkInvertDisplacementField&) = delete;
  void operator=(const vtkInvertDisplacementField&) = delete;

  double LargestError = 0.0;
};

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDeformationField
 * @brief   a deformation as numbers on a grid: displacements and Jacobian determinants
 *
 * Input: a deformable volume, the output of Free-Form Deformation. Output: an image over the
 * volume's box and along its axes, with a field array that names the direction (FieldDirection.h)
 * and these point arrays:
 *
 *     Displacement         float32 x 3 (mm, world axes): where the map takes the point, minus the
 *                          point itself
 *     JacobianDeterminant  float32: the factor by which the map changes a small volume; 1 keeps it,
 *                          0 or less folds tissue
 *     Deviation            float32 (mm), only of a fit with Evidence: one standard deviation along
 *                          an axis of the place of the tissue, infinity where nothing was measured
 *
 * The first two come from the cubic itself, as PointMap evaluates it; Deviation is trilinear
 * between control points at rest. The filter runs on all cores, reports
 * progress and can be aborted.
 */
#ifndef vtkDeformationField_h
#define vtkDeformationField_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro
#include "vtkImageAlgorithm.h"

#include <string> // for messages

namespace brainshift
{
struct Grid;
}

class VTKBRAINSHIFTFILTERS_EXPORT vtkDeformationField : public vtkImageAlgorithm
{
public:
  static vtkDeformationField* New();
  vtkTypeMacro(vtkDeformationField, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;
  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  enum DirectionType
  {
    Forward = 0,  ///< deformedFromRest at rest points
    Backward = 1, ///< restFromDeformed at deformed points
  };

  enum SampleGridType
  {
    Volume = 0,          ///< the volume's own points
    GivenDimensions = 1, ///< Dimensions points over the volume's box
    GivenSpacing = 2,    ///< points every Spacing mm from the volume's first one
  };

  ///@{
  /**
   * Forward: where tissue goes, for moving points. Backward: which tissue is seen, for resampling
   * images. Default Backward.
   */
  vtkSetClampMacro(Direction, int, Forward, Backward);
  vtkGetMacro(Direction, int);
  ///@}

  ///@{
  /** The points of the output: Volume (default), GivenDimensions or GivenSpacing. */
  vtkSetClampMacro(SampleGrid, int, Volume, GivenSpacing);
  vtkGetMacro(SampleGrid, int);
  ///@}

  ///@{
  /**
   * Points along each axis of the volume, 2 to 4096, if SampleGrid is GivenDimensions. Default
   * 64 64 64.
   */
  vtkSetVector3Macro(Dimensions, int);
  vtkGetVector3Macro(Dimensions, int);
  ///@}

  ///@{
  /**
   * mm between points along each axis of the volume, if SampleGrid is GivenSpacing. It may be as
   * long as the volume, and so short that there are 4096 points. Default 4 4 4.
   */
  vtkSetVector3Macro(Spacing, double);
  vtkGetVector3Macro(Spacing, double);
  ///@}

protected:
  vtkDeformationField() = default;
  ~vtkDeformationField() override = default;

  int RequestInformation(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestUpdateExtent(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkDeformationField(const vtkDeformationField&) = delete;
  void operator=(const vtkDeformationField&) = delete;

  // The grid to sample on. If it cannot be used, `problem` becomes a sentence.
  brainshift::Grid SamplesOver(const brainshift::Grid& volume) const;

  int Direction = Backward;
  int SampleGrid = Volume;
  int Dimensions[3] = { 64, 64, 64 };
  double Spacing[3] = { 4.0, 4.0, 4.0 };
};

#endif

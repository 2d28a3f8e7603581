// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDeformationField
 * @brief   a deformation as numbers on a grid: displacements and Jacobian determinants
 *
 * Input: the deformable volume, output of Free-Form Deformation. Output: an image over the
 * volume's box, along its axes (direction matrix included), with point arrays
 *   Displacement         float32 x 3 (mm, world axes): where the map leads, minus the point itself
 *   JacobianDeterminant  float32: what the map makes of a small volume; 1 keeps it, 0 or less folds
 * and a field array that names the direction (FieldDirection.h). Both come from the cubic itself,
 * as PointMap evaluates it. Runs on all cores; reports progress and can be aborted.
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

  enum DirectionType
  {
    Forward = 0,  // deformedFromRest at rest points
    Backward = 1, // restFromDeformed at deformed points
  };

  enum SampleGridType
  {
    Volume = 0,          // the volume's own points
    GivenDimensions = 1, // Dimensions points over its box
    GivenSpacing = 2,    // points every Spacing mm from its first one
  };

  ///@{
  /** Forward (default): where tissue goes. Backward: which tissue is seen. */
  vtkSetClampMacro(Direction, int, Forward, Backward);
  vtkGetMacro(Direction, int);
  ///@}

  ///@{
  /** Which points: Volume (default), GivenDimensions or GivenSpacing. */
  vtkSetClampMacro(SampleGrid, int, Volume, GivenSpacing);
  vtkGetMacro(SampleGrid, int);
  ///@}

  ///@{
  /** Points along the volume's axes, 2 to 4096 each, if SampleGrid asks. Default 64 64 64. */
  vtkSetVector3Macro(Dimensions, int);
  vtkGetVector3Macro(Dimensions, int);
  ///@}

  ///@{
  /** mm between points along the volume's axes, if SampleGrid asks. Default 4 4 4. */
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

  // The grid to sample on. What is wrong with it, if anything is, comes back in `problem`.
  brainshift::Grid SamplesOver(const brainshift::Grid& volume, std::string& problem) const;

  int Direction = Forward;
  int SampleGrid = Volume;
  int Dimensions[3] = { 64, 64, 64 };
  double Spacing[3] = { 4.0, 4.0, 4.0 };
};

#endif

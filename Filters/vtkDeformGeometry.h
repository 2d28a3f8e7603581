// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDeformGeometry
 * @brief   moves meshes, tracts, traces and landmarks with a deformed volume
 *
 * Input 0: any point set; its points are mapped, all else passes. Normals of points and cells are
 * turned so that they stay across the surface; other vectors stay as they are. Points that are not
 * finite stay. Input 1: the deformable volume, output of Free-Form Deformation.
 *
 * Maps are those of PointMap: the cubic itself, not the field pictures are drawn with. Runs on all
 * cores; reports progress and can be aborted.
 */
#ifndef vtkDeformGeometry_h
#define vtkDeformGeometry_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro
#include "vtkPassInputTypeAlgorithm.h"

class VTKBRAINSHIFTFILTERS_EXPORT vtkDeformGeometry : public vtkPassInputTypeAlgorithm
{
public:
  static vtkDeformGeometry* New();
  vtkTypeMacro(vtkDeformGeometry, vtkPassInputTypeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum DirectionType
  {
    Forward = 0,  // deformedFromRest
    Backward = 1, // restFromDeformed
  };

  ///@{
  /** Forward (default): from where tissue rests to where it is drawn. Backward: the inverse. */
  vtkSetClampMacro(Direction, int, Forward, Backward);
  vtkGetMacro(Direction, int);
  ///@}

  /** The deformable volume: second input. */
  void SetDeformationConnection(vtkAlgorithmOutput* volume);

protected:
  vtkDeformGeometry();
  ~vtkDeformGeometry() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkDeformGeometry(const vtkDeformGeometry&) = delete;
  void operator=(const vtkDeformGeometry&) = delete;

  int Direction = Forward;
};

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDeformGeometry
 * @brief   moves meshes, tracts, traces and landmarks with a deformed volume
 *
 * Input 0: any point set, in world mm. Its points are mapped and everything else passes. Normals of
 * points and cells are turned, so that they stay perpendicular to the surface. Other vectors stay
 * as they are. Points that are not finite stay. Input 1: a deformable volume, the output of
 * Free-Form Deformation.
 *
 * The maps are those of PointMap: the cubic itself, not the field that pictures are drawn with. The
 * filter runs on all cores, reports progress and can be aborted.
 */
#ifndef vtkDeformGeometry_h
#define vtkDeformGeometry_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro
#include "vtkPassInputTypeAlgorithm.h"

#include <string>

class VTKBRAINSHIFTFILTERS_EXPORT vtkDeformGeometry : public vtkPassInputTypeAlgorithm
{
public:
  static vtkDeformGeometry* New();
  vtkTypeMacro(vtkDeformGeometry, vtkPassInputTypeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;
  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  enum DirectionType
  {
    Forward = 0,  ///< deformedFromRest: where tissue goes
    Backward = 1, ///< restFromDeformed: which tissue is seen
  };

  ///@{
  /** Forward: from the rest frame to the deformed frame. Backward: the inverse. Default Forward. */
  vtkSetClampMacro(Direction, int, Forward, Backward);
  vtkGetMacro(Direction, int);
  ///@}

  /** The deformable volume (input 1). */
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
  std::string Warned;
};

#endif

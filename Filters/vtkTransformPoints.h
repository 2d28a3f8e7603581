// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTransformPoints
 * @brief   moves landmarks and traced points with the transform of a registration program
 *
 * Input: points in mm, world axes. They are mapped by the file's own map, without a lattice or a
 * field in between. Normals of points turn with the surface, normals of cells are left out. All
 * other arrays pass as they are, vectors too.
 *
 * The filter runs on all cores, reports progress and can be aborted. It belongs to no menu:
 * `brainshift.map_points` and `brainshift.open_scene` use it.
 */
#ifndef vtkTransformPoints_h
#define vtkTransformPoints_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro
#include "vtkPolyDataAlgorithm.h"
#include "vtkSmartPointer.h" // for the transform

class vtkTransformReader;

class VTKBRAINSHIFTFILTERS_EXPORT vtkTransformPoints : public vtkPolyDataAlgorithm
{
public:
  static vtkTransformPoints* New();
  vtkTypeMacro(vtkTransformPoints, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;
  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  vtkMTimeType GetMTime() override;

  enum DirectionType
  {
    Forward = 0,  ///< from the fixed image to the moving one
    Backward = 1, ///< from the moving image to the fixed one
  };

  ///@{
  /** Forward: as the file's own map leads. Backward: its inverse, solved for each point. Default
   * Forward. */
  vtkSetClampMacro(Direction, int, Forward, Backward);
  vtkGetMacro(Direction, int);
  ///@}

  /** The reader of the files, in the world of the points. Default: null, which is an error. */
  void SetTransform(vtkTransformReader* transform);

protected:
  vtkTransformPoints();
  ~vtkTransformPoints() override;

  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkTransformPoints(const vtkTransformPoints&) = delete;
  void operator=(const vtkTransformPoints&) = delete;

  vtkSmartPointer<vtkTransformReader> Transform;
  int Direction = Forward;
};

#endif

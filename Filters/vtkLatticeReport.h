// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkLatticeReport
 * @brief   finds control points of a deformed lattice where the data is
 *
 * Tools in the view need the few control points near the cursor. The lattice may have millions and
 * may lie on a server. This object lives beside the filter, and the XML proxy of the same name
 * brings its answers to the client. It reads the filter's output, so the answers are what is drawn.
 *
 * Positions and lengths are mm, world. Nothing is kept between two questions but the longest
 * displacement and the map of the tissue.
 */
#ifndef vtkLatticeReport_h
#define vtkLatticeReport_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro
#include "vtkNew.h"                     // for answers
#include "vtkObject.h"
#include "vtkWeakPointer.h" // for what is asked

#include <memory> // for the map
#include <vector>

class vtkAlgorithm;
class vtkDoubleArray;
class vtkFloatArray;
namespace brainshift
{
struct DrawnLattice;
class PointMap;
}

class VTKBRAINSHIFTFILTERS_EXPORT vtkLatticeReport : public vtkObject
{
public:
  static vtkLatticeReport* New();
  vtkTypeMacro(vtkLatticeReport, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** The filter whose output carries the lattice. */
  void SetFilter(vtkAlgorithm* filter);

  ///@{
  /**
   * Asks for the control points in a ball (deformed frame): centre and radius. Default radius 0: no
   * ball.
   */
  vtkSetVector4Macro(Ball, double);
  vtkGetVector4Macro(Ball, double);
  ///@}

  /**
   * Asks for the control points in a cone (deformed frame): apex, unit direction, radius at the
   * apex, growth of the radius for each mm. Default radius and growth 0: no cone.
   */
  void SetCone(const double cone[8]);

  ///@{
  /**
   * Asks for the control points that have moved, within this radius of the ball's centre. Default
   * 0: none of them.
   */
  vtkSetMacro(MovedWithin, double);
  vtkGetMacro(MovedWithin, double);
  ///@}

  /**
   * Limits the answers for the ball and for moved points to control points near a plane (deformed
   * frame): a point of the plane, its unit normal, the largest distance. Default distance 0: no
   * limit.
   */
  void SetSlab(const double slab[7]);

  /**
   * The control points that were asked for, each of them once, and at most 1000 for each question.
   * A tuple has nine components: index along the three lattice axes, rest position, position as
   * drawn.
   */
  vtkDoubleArray* GetControlPoints();

  ///@{
  /**
   * Asks where the tissue at these places lies in the other frame. ToRest: the places are in the
   * deformed frame and the answers in the rest frame (default), or else the other way round.
   */
  void AddPlace(double x, double y, double z);
  void ClearPlaces();
  vtkSetMacro(ToRest, bool);
  vtkGetMacro(ToRest, bool);
  ///@}

  /** For each place, the tissue's position in the other frame. Empty without a deformation. */
  vtkDoubleArray* GetSameTissue();

  /**
   * The lattice as 18 numbers: points along each axis, position of the first one, spacing,
   * direction matrix row by row. Empty if the filter's output carries no lattice.
   */
  vtkDoubleArray* GetGeometry();

protected:
  vtkLatticeReport();
  ~vtkLatticeReport() override;

private:
  void ListControlPoints(vtkFloatArray* displacements, brainshift::DrawnLattice& lattice);
  void FindSameTissue();
  void FindFarthest(vtkFloatArray* displacements, brainshift::DrawnLattice& lattice);

  vtkLatticeReport(const vtkLatticeReport&) = delete;
  void operator=(const vtkLatticeReport&) = delete;

  vtkWeakPointer<vtkAlgorithm> Filter;
  double Ball[4] = { 0.0, 0.0, 0.0, 0.0 };
  double Cone[8] = { 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0 };
  double MovedWithin = 0.0;
  double Slab[7] = { 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0 };
  // Of the displacements that were read last: a moving cursor then reads only a few of them.
  vtkWeakPointer<vtkFloatArray> Known;
  vtkMTimeType KnownTime = 0;
  double Farthest = 0.0; // mm
  vtkNew<vtkDoubleArray> ControlPoints;
  vtkNew<vtkDoubleArray> Geometry;
  std::vector<double> Places;
  bool ToRest = true;
  std::unique_ptr<brainshift::PointMap> Map; // a mask makes it slow to build
  unsigned long long MapTime = 0;
  vtkNew<vtkDoubleArray> SameTissue;
};

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkLatticeReport
 * @brief   control points of a deformed lattice, asked where the data is
 *
 * Tools in the view need the few control points near the cursor, of a lattice that may have
 * millions and may lie on a server. This object lives beside the filter; the XML proxy of the same
 * name brings its answers to the client. They are read from the filter's output, so they are what
 * is drawn, whatever bent it.
 */
#ifndef vtkLatticeReport_h
#define vtkLatticeReport_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro
#include "vtkNew.h"                     // for answers
#include "vtkObject.h"
#include "vtkWeakPointer.h" // for what is asked

class vtkAlgorithm;
class vtkDoubleArray;
class vtkFloatArray;
namespace brainshift
{
struct DrawnLattice;
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
  /** Ball (mm, deformed frame) whose control points are told: centre and radius. Default radius 0:
   * none. */
  vtkSetVector4Macro(Ball, double);
  vtkGetVector4Macro(Ball, double);
  ///@}

  ///@{
  /** Cone (mm, deformed frame) whose control points are told: apex, unit direction, radius at the
   * apex, growth of the radius a mm. Default radius and growth 0: none. */
  void SetCone(const double cone[8]);
  ///@}

  ///@{
  /** Radius (mm) about the ball's centre within which those that moved are told, too. Default 0:
   * none. */
  vtkSetMacro(MovedWithin, double);
  vtkGetMacro(MovedWithin, double);
  ///@}

  /** Of both, only those near a plane (mm, deformed frame) are told: a point of it, its unit
   * normal, the largest distance. Default distance 0: all. */
  void SetSlab(const double slab[7]);

  /**
   * Control points asked for, each once, at most 1000 for each question: index along the three
   * lattice axes, rest position, position as drawn (mm). Nine components.
   */
  vtkDoubleArray* GetHandles();

  /**
   * The lattice, 1 tuple of 18: points along each axis, position of the first (mm), spacing (mm),
   * direction matrix row by row. Empty if the filter's output carries none.
   */
  vtkDoubleArray* GetGeometry();

protected:
  vtkLatticeReport();
  ~vtkLatticeReport() override;

private:
  void FindFarthest(vtkFloatArray* displacements, brainshift::DrawnLattice& lattice);

  vtkLatticeReport(const vtkLatticeReport&) = delete;
  void operator=(const vtkLatticeReport&) = delete;

  vtkWeakPointer<vtkAlgorithm> Filter;
  double Ball[4] = { 0.0, 0.0, 0.0, 0.0 };
  double Cone[8] = { 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0 };
  double MovedWithin = 0.0;
  double Slab[7] = { 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0 };
  // Of the control points that were asked last, so that a cursor that moves asks few of them.
  vtkWeakPointer<vtkFloatArray> Known;
  vtkMTimeType KnownTime = 0;
  double Farthest = 0.0; // mm
  vtkNew<vtkDoubleArray> Handles;
  vtkNew<vtkDoubleArray> Geometry;
};

#endif

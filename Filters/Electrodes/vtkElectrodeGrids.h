// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkElectrodeGrids
 * @brief   finds where the tissue under the contacts of electrodes was at rest
 *
 * - Input 0: contacts as they were measured (points, mm, world, measured frame), with an optional
 *   point array Label, such as G1 to G64.
 * - Input 1: the cortex at rest: a volume or labels (an image), or a surface (triangles).
 * - Input 2 (optional): a mask of the opening of the skull, rest frame.
 *
 * Contacts of a grid are fitted with their sheet (SheetFit.h). Others stay where they were.
 *
 * Output 0: a point for each contact in the order of the input, at rest, to be the Rest Landmarks
 * of a Fit Deformation whose Measured Landmarks are input 0. Its point arrays:
 *
 * - Label; Array (the name of the electrode) and Electrode (its number, from 1 on, in the order of
 *   GetElectrodes); Kind ("grid", "strip", "depth", "unknown"); Row and Column (from 1 on;
 *   0: none); Missing (0 or 1)
 * - Measured (3 numbers, mm, measured frame): the contact; Bent (likewise): on the bent cortex
 * - Outside (mm): how far the contact is outside of the bent cortex, negative if it is buried;
 *   Deviation (mm): standard deviation of the position at rest along the cortex; LeftOut (mm): the
 *   contact from where all others predict it. All are NaN for a contact on no grid.
 * - Weight: 1, or 0 for a contact that a fit must leave out
 *
 * With ShowMissing, predicted contacts of grids follow, whose Measured is Bent.
 *
 * Output 1: the contacts that lie on the cortex, as measured, with Label: the Traces of that fit.
 * Contacts of grids that float or are buried are left out, and so are shafts. Strips and electrodes
 * without an order are there, unless one of their contacts is more than 15 mm below the cortex at
 * rest.
 */
#ifndef vtkElectrodeGrids_h
#define vtkElectrodeGrids_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro
#include "vtkPolyDataAlgorithm.h"

#include <memory> // for the private part
#include <string>
#include <vector>

class VTKBRAINSHIFTFILTERS_EXPORT vtkElectrodeGrids : public vtkPolyDataAlgorithm
{
public:
  static vtkElectrodeGrids* New();
  vtkTypeMacro(vtkElectrodeGrids, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;
  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int ModifyRequest(vtkInformation* request, int when) override;

  ///@{
  /**
   * How an image shows the cortex, as for vtkTraceDistance: the array (empty, the default: the
   * active scalars); 0 (default): scalars at or above Threshold (default 0.5), or 1: equal to Label
   * (default 1). A surface needs none of it.
   */
  vtkSetMacro(SurfaceArray, std::string);
  vtkGetMacro(SurfaceArray, std::string);
  vtkSetClampMacro(SurfaceBy, int, 0, 1);
  vtkGetMacro(SurfaceBy, int);
  vtkSetMacro(Threshold, double);
  vtkGetMacro(Threshold, double);
  vtkSetMacro(Label, int);
  vtkGetMacro(Label, int);
  ///@}

  ///@{
  /** Factor on the stiffness of the sheets, 0 to 100. Default 1; 0: they stretch freely. */
  vtkSetMacro(Stiffness, double);
  vtkGetMacro(Stiffness, double);
  ///@}

  ///@{
  /** Standard deviation (mm) of a measured contact along each axis, above 0. Default 0.5. */
  vtkSetMacro(ContactDeviation, double);
  vtkGetMacro(ContactDeviation, double);
  ///@}

  ///@{
  /**
   * The opening as a ball: centre (mm, rest frame) and radius (mm). Default radius 0: the ball that
   * holds the contacts of all grids. The cortex stays beyond 15 mm of it. A mask (input 2) counts
   * instead.
   */
  vtkSetVector3Macro(OpeningCentre, double);
  vtkGetVector3Macro(OpeningCentre, double);
  vtkSetMacro(OpeningRadius, double);
  vtkGetMacro(OpeningRadius, double);
  ///@}

  ///@{
  /** Whether the output has the missing contacts of grids, too. Default off. */
  vtkSetMacro(ShowMissing, bool);
  vtkGetMacro(ShowMissing, bool);
  vtkBooleanMacro(ShowMissing, bool);
  ///@}

  ///@{
  /**
   * World axes (WorldAxes.h) of contacts that do not say theirs: 1 RAS, 2 LPS, 0 (default) unknown.
   * A warning reports contacts whose axes are not those of the cortex or of the opening.
   */
  vtkSetClampMacro(PointAxes, int, 0, 2);
  vtkGetMacro(PointAxes, int);
  ///@}

  ///@{
  /** Labels, in their order, of contacts whose input has no array Label. Default: none. */
  void AddContactName(const char* name);
  void ClearContactNames();
  ///@}

  ///@{
  /** The electrode of each contact. Default: what is before the number in its label. */
  void AddContactGroup(const char* name);
  void ClearContactGroups();
  ///@}

  ///@{
  /** What is known of electrodes, such as "LTG=8x8 10mm" (hintIn in ContactArrays.h). */
  void AddShape(const char* hint);
  void ClearShapes();
  ///@}

  /**
   * The electrodes of the last execution, a line for each: name, kind, rows, columns, pitch (mm),
   * 1 if labels say the order, the labels of its places row after row with commas between, and the
   * missing ones of these, with tabs between.
   */
  std::string GetElectrodes() const;

  /** What a user must know about the result: sentences, without the last full stop; or empty. */
  std::string GetWarning() const;

  /** Why there is no result, a sentence without a full stop; empty if there is one. */
  std::string GetProblem() const;

protected:
  vtkElectrodeGrids();
  ~vtkElectrodeGrids() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkElectrodeGrids(const vtkElectrodeGrids&) = delete;
  void operator=(const vtkElectrodeGrids&) = delete;

  std::string SurfaceArray;
  int SurfaceBy = 0;
  double Threshold = 0.5;
  int Label = 1;
  double Stiffness = 1.0;
  double ContactDeviation = 0.5;
  double OpeningCentre[3] = { 0.0, 0.0, 0.0 };
  double OpeningRadius = 0.0;
  bool ShowMissing = false;
  int PointAxes = 0;
  std::vector<std::string> ContactNames;
  std::vector<std::string> ContactGroups;
  std::vector<std::string> Shapes;

  // Each throws a Problem if it cannot.
  void ReadContacts(vtkInformationVector** inputs);
  void FindCortex(vtkInformationVector** inputs);
  void Fit(vtkInformationVector** inputs);
  // A sentence on world axes that are not those of the contacts; empty if there is none.
  std::string DoubtsAboutSides(vtkInformationVector** inputs);

  struct State;
  std::unique_ptr<State> Internal;
};

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkFitDeformation
 * @brief   bends a volume by what was measured, with the uncertainty
 *
 * Output: a lattice, an image with the point array Displacement (float32 x 3, mm, world axes,
 * forward), to be the Lattice of a Free-Form Deformation with the same LatticeDimensions, Kernel,
 * Samples and mask; with Evidence also Deviation. The rigid part is kept apart: GetRigid belongs in
 * the pose of the tracker or of the reference. All measurements are solved together
 * (Filters/Fit/Fit.h).
 *
 * - Input 0: the volume at rest. Only its grid counts, and its scalars if they show the cortex.
 * - Input 1 (optional): the base, a forward field on any grid (mm), say of a refinement. What was
 *   measured bends the volume from there. The rigid part is then the identity.
 * - Input 2 (optional): the mask of the Free-Form Deformation.
 * - Input 3, 4 (optional): landmarks at rest and measured, points with an optional array Label.
 *   They match by label, and by order where neither has labels. Labels of which none is on both
 *   lists are an error. An array Weight of the landmarks at rest divides their variance; 0 switches
 *   a landmark off.
 * - Input 5 (optional): points traced on the cortex, measured frame.
 * - Input 6 (optional): a segmentation at rest; the cortex is taken from it, not the volume.
 * - Input 7 (optional): a cavity, measured frame. Traced points in it do not count.
 * - Input 8 (optional): a mask of the opening of the skull, rest frame.
 *
 * If the bend would fold tissue, the measurements are trusted less (factor 1.5 on their deviations)
 * and, if that is not enough, a fraction of the bend is taken.
 */
#ifndef vtkFitDeformation_h
#define vtkFitDeformation_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro
#include "vtkLatticeAlgorithm.h"

#include <memory> // for the private part
#include <string>
#include <vector>

class vtkDoubleArray;
class vtkStringArray;
namespace brainshift
{
class FitLandmarks;
class Process;
}

class VTKBRAINSHIFTFILTERS_EXPORT vtkFitDeformation : public vtkLatticeAlgorithm
{
public:
  static vtkFitDeformation* New();
  vtkTypeMacro(vtkFitDeformation, vtkLatticeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;
  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int ModifyRequest(vtkInformation* request, int when) override;

  ///@{
  /** Whether the fold guard may shorten the bend. Default on. */
  vtkSetMacro(GuardFolding, bool);
  vtkGetMacro(GuardFolding, bool);
  vtkBooleanMacro(GuardFolding, bool);
  ///@}

  ///@{
  /**
   * Whether the user drags something that was measured at this moment. Default off. If on, traced
   * points are projected with the last fit and the equations are solved once. Beside traces the
   * bend then trails the hand by about a third of its last step. Switch it off when the hand lets
   * go.
   */
  vtkSetMacro(Live, bool);
  vtkGetMacro(Live, bool);
  vtkBooleanMacro(Live, bool);
  ///@}

  ///@{
  /**
   * Name of the array in which to find the cortex. Empty (default): the active scalars. It is an
   * error if the volume has none of this name; a segmentation then gives its active scalars.
   */
  vtkSetMacro(SurfaceArray, std::string);
  vtkGetMacro(SurfaceArray, std::string);
  ///@}

  ///@{
  /** How tissue is found. 0: scalars at or above Threshold (default); 1: scalars equal to Label. */
  vtkSetClampMacro(SurfaceBy, int, 0, 1);
  vtkGetMacro(SurfaceBy, int);
  ///@}

  ///@{
  /** Smallest scalar of tissue. Default 0.5: the edge of a mask of 0 and 1. */
  vtkSetMacro(Threshold, double);
  vtkGetMacro(Threshold, double);
  ///@}

  ///@{
  /** Label of the tissue. Default 1. */
  vtkSetMacro(Label, int);
  vtkGetMacro(Label, int);
  ///@}

  ///@{
  /**
   * Whether the cortex is held beyond 15 mm of the opening. Default on. It is held when there are
   * traces, and beside pulls if the opening is given.
   */
  vtkSetMacro(Anchors, bool);
  vtkGetMacro(Anchors, bool);
  vtkBooleanMacro(Anchors, bool);
  ///@}

  ///@{
  /**
   * The opening as a ball: centre (mm, rest frame) and radius (mm). Default radius 0: the ball that
   * holds what was traced and pulled. A mask of the opening (input 6) counts instead.
   */
  vtkSetVector3Macro(OpeningCentre, double);
  vtkGetVector3Macro(OpeningCentre, double);
  vtkSetMacro(OpeningRadius, double);
  vtkGetMacro(OpeningRadius, double);
  ///@}

  ///@{
  /**
   * World axes (WorldAxes.h) of points that do not say theirs: 1 RAS, 2 LPS, 0 (default) unknown.
   * A warning reports points whose axes are not those of the volume.
   */
  vtkSetClampMacro(PointAxes, int, 0, 2);
  vtkGetMacro(PointAxes, int);
  ///@}

  ///@{
  /** The labels of the cavity. Default: none, which means every value above 0. */
  void AddCavityLabel(int label);
  void ClearCavityLabels();
  ///@}

  ///@{
  /**
   * Whether the output carries the point array Deviation (float32, mm): the standard deviation of
   * the displacement at each control point, as Deviations() returns it. It takes time. Default off.
   */
  vtkSetMacro(Evidence, bool);
  vtkGetMacro(Evidence, bool);
  vtkBooleanMacro(Evidence, bool);
  ///@}

  ///@{
  /**
   * Pairs of landmarks besides those of the inputs: 7 numbers each, where the landmark was (mm,
   * rest frame), where it was measured (mm) and its weight (0: switched off). Default: none.
   */
  void AddLandmarkPair(double number);
  void ClearLandmarkPairs();
  ///@}

  ///@{
  /** Names of landmarks of the inputs that are off: see GetLandmarkNames. Default: none. */
  void AddLandmarkOff(const char* name);
  void ClearLandmarksOff();
  ///@}

  ///@{
  /** Whether landmarks of the inputs match by their order whatever their labels. Default off. */
  void SetPairByOrder(bool byOrder);
  bool GetPairByOrder() const;
  ///@}

  ///@{
  /** Labels, in their order, of landmarks whose input has no array Label. Default: none. */
  void AddRestName(const char* name);
  void ClearRestNames();
  void AddMeasuredName(const char* name);
  void ClearMeasuredNames();
  ///@}

  ///@{
  /**
   * Pulls: 7 numbers each, where tissue was (mm, rest frame), where it was put (mm) and its weight
   * (0: switched off).
   */
  void AddPull(double number) { this->Append(this->Pulls, number); }
  void ClearPulls() { this->Clear(this->Pulls); }
  ///@}

  ///@{
  /** Pins: 4 numbers each, tissue that stays (mm, rest frame) and 1 or 0 (switched off). */
  void AddPin(double number) { this->Append(this->Pins, number); }
  void ClearPins() { this->Clear(this->Pins); }
  ///@}

  ///@{
  /**
   * Figures of the last execution. Share: the fraction of the fitted bend that the fold guard
   * allowed, 0 to 1; the base is not included. Relaxation: factor on the deviations, 1 or 1.5.
   * TraceRMS: root mean square distance (mm) of traced points from the bent cortex, NaN without
   * any.
   */
  double GetShare() const;
  double GetRelaxation() const;
  double GetTraceRMS() const;
  ///@}

  /** Factor on all deviations that makes them agree with what leaving pairs out showed. */
  double GetCalibration() const;

  /** How often traced points were projected, and how many anchors held the cortex. */
  int GetSteps() const;
  int GetAnchorCount() const;

  /** The rigid part, measured from rest: a matrix of 4 x 4 numbers (mm), row after row. */
  vtkDoubleArray* GetRigid();

  ///@{
  /**
   * Distance (mm) of each matched landmark and each pull from its measured end, and of each traced
   * point from the bent cortex, positive outside it. NaN for one that does not count.
   */
  vtkDoubleArray* GetLandmarkResiduals();
  vtkDoubleArray* GetPullResiduals();
  vtkDoubleArray* GetTraceResiduals();
  ///@}

  /**
   * For each matched landmark its leave-one-out error (mm): the distance between the measured
   * landmark and its prediction by a fit without it. For one that is switched off, the distance
   * from the prediction of the fit. The fold guard and the mask are not counted.
   */
  vtkDoubleArray* GetLeaveOneOut();

  ///@{
  /**
   * The matched landmarks in the order of all figures: first those of the inputs, then those of
   * AddLandmarkPair. Their names: the label at rest, or the number at rest from 1 on, or "Pair 1".
   * Their places, 10 numbers each: at rest, measured, where the fit puts it (mm, measured frame),
   * and its weight (0: switched off).
   */
  vtkStringArray* GetLandmarkNames();
  vtkDoubleArray* GetLandmarkPlaces();
  ///@}

  /** Why there is no result, a sentence without a full stop; empty if there is one. */
  const char* GetProblem() const;

  /** The landmarks without a partner, with commas between them; empty if there are none. */
  const char* GetUnmatched() const;

  /** What a user must know about the result: sentences, without the last full stop; or empty. */
  std::string GetWarning() const;

  ///@{
  /**
   * For positions (mm, rest frame), three numbers each: the position at which their tissue was or
   * would be measured, by lattice and rigid part; and its standard deviation (mm) along each axis.
   * Deviations are infinite if nothing was measured, and count what guard, mask and control
   * points changed.
   */
  std::vector<double> MeasuredFromRest(const std::vector<double>& rest);
  std::vector<double> Deviations(const std::vector<double>& rest);
  ///@}

  ///@{
  /**
   * The equations of the last fit, from which fields of its process can be drawn. Rows: 7 numbers
   * each, the position (mm, rest frame), the unit axis along which the displacement is measured
   * there, and the variance (mm^2). Covariance: the length (mm) and the standard deviation (mm) of
   * the Matern covariance (Process.h). Both are empty without a fit. Landmarks alone are
   * near-rigid; their free rigid motion is not in the rows.
   */
  std::vector<double> Rows() const;
  std::vector<double> Covariance() const;
  ///@}

protected:
  vtkFitDeformation();
  ~vtkFitDeformation() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestUpdateExtent(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkFitDeformation(const vtkFitDeformation&) = delete;
  void operator=(const vtkFitDeformation&) = delete;

  bool GuardFolding = true;
  bool Live = false;
  std::string SurfaceArray;
  int SurfaceBy = 0;
  double Threshold = 0.5;
  int Label = 1;
  bool Anchors = true;
  double OpeningCentre[3] = { 0.0, 0.0, 0.0 };
  double OpeningRadius = 0.0;
  int PointAxes = 0;
  bool Evidence = false;
  std::vector<double> Pulls;
  std::vector<double> Pins;
  std::vector<int> CavityLabels;
  const std::unique_ptr<brainshift::FitLandmarks> Landmarks;

  // Each throws a Problem if it cannot.
  void RequireProperties() const;
  void ReadMeasurements(vtkInformationVector** inputs);
  std::string DoubtsAboutSides(vtkInformationVector** inputs);
  void FindCortex(vtkInformationVector** inputs);
  void FindAnchors(vtkInformationVector** inputs);
  void FindBase(vtkInformationVector** inputs);
  void Solve(const brainshift::Process* start);

  struct State;
  std::unique_ptr<State> Internal;
};

#endif

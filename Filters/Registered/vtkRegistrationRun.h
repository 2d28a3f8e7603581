// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkRegistrationRun
 * @brief   aligns a reference or refines a deformation, a short part for each call
 *
 * The volumes may be on a server. This object is beside them, and the XML proxy of the same name
 * transfers its figures to the client. It changes nothing in the pipeline: the client applies the
 * result. Begin with BeginAlignment or BeginRefinement, then call Step until it is finished or
 * enough.
 */
#ifndef vtkRegistrationRun_h
#define vtkRegistrationRun_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro
#include "vtkNew.h"                     // for results
#include "vtkObject.h"
#include "vtkWeakPointer.h" // for the source

#include <memory> // for the private part
#include <string>

class vtkAlgorithm;
class vtkDoubleArray;

class VTKBRAINSHIFTFILTERS_EXPORT vtkRegistrationRun : public vtkObject
{
public:
  static vtkRegistrationRun* New();
  vtkTypeMacro(vtkRegistrationRun, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** A Compare Volumes that is up to date, or a filter that passes its output on. */
  void SetSource(vtkAlgorithm* source);

  ///@{
  /**
   * The similarity of a refinement: its index in the lists below, from 0 on. Default 0.
   * A number beyond the list is replaced by the nearest one.
   */
  void SetSimilarity(int similarity);
  vtkGetMacro(Similarity, int);
  ///@}

  ///@{
  /** All similarities, one in each line: names for scripts, labels and tooltips for panels. */
  const char* GetSimilarityNames() const { return this->SimilarityNames.c_str(); }
  const char* GetSimilarityLabels() const { return this->SimilarityLabels.c_str(); }
  const char* GetSimilarityTooltips() const { return this->SimilarityTooltips.c_str(); }
  ///@}

  ///@{
  /** Factor on the stiffness in a refinement; above 0. Default 1. */
  vtkSetMacro(Stiffness, double);
  vtkGetMacro(Stiffness, double);
  ///@}

  ///@{
  /** Whether a result that fails its checks is kept; else Refusal has the reason. Default 0. */
  vtkSetMacro(KeepFailed, int);
  vtkGetMacro(KeepFailed, int);
  ///@}

  ///@{
  /**
   * Number of positions from which a search begins: the present one, and others near it, always the
   * same. The result with the least cost is kept. 1 to 64. An alignment and a refinement whose
   * volume first moves rigidly take note of it. Default 1.
   */
  void SetStarts(int starts);
  vtkGetMacro(Starts, int);
  ///@}

  ///@{
  /** Begins again, from the present position of the reference or the present deformation. */
  void BeginAlignment();
  void BeginRefinement();
  ///@}

  /**
   * Takes one step; a refinement may try a length of it, or prepare a part of its next level. After
   * the last step it checks the result, a part for each call. Nothing once it is finished, or
   * without a beginning.
   */
  void Step();

  /**
   * Ends it where it is. If a refinement goes on from a checked result, and has not yet found a
   * better one, that result is kept, with its verdict. Otherwise nothing changes.
   */
  void Stop();

  ///@{
  /**
   * The position of the reference at the start of an alignment, as its Compare Volumes has it:
   * degrees about x, then y, then z, and mm. Default 0 0 0.
   */
  vtkSetVector3Macro(StartRotation, double);
  vtkGetVector3Macro(StartRotation, double);
  vtkSetVector3Macro(StartTranslation, double);
  vtkGetVector3Macro(StartTranslation, double);
  ///@}

  /**
   * The reason if it could not begin or ended early: a sentence without a full stop. Else empty.
   */
  const char* GetProblem() const { return this->Problem.c_str(); }

  /**
   * The reason to discard the result: a sentence without a full stop. Empty if there is none. An
   * alignment needs a partner in the reference for 25 % of the volume, a refinement for any of it;
   * and a result must not fail its checks, unless KeepFailed is on.
   */
  const char* GetRefusal() const { return this->Refusal.c_str(); }

  /** Warnings about the result: sentences, one in each line. Empty if there are none. */
  const char* GetWarning() const { return this->Warning.c_str(); }

  /**
   * How far the result may be trusted, by checks of itself: "good", "doubtful" or "failed"; and
   * "unchecked" until they have ended, or if too little was compared.
   */
  const char* GetTrust() const { return this->Trust.c_str(); }

  ///@{
  /** After the last step, of both kinds of run. */
  vtkGetMacro(Finished, int);   ///< 1 at its end, else 0
  vtkGetMacro(Checking, int);   ///< 1 while it checks its result, else 0
  vtkGetMacro(Steps, int);      ///< that were taken; of an alignment: lines searched
  vtkGetMacro(Level, int);      ///< of the pyramid, from 0 on, the coarsest
  vtkGetMacro(Done, double);    ///< fraction of the most steps there may be, 0 to 1
  vtkGetMacro(Overlap, double); ///< fraction of OverlapOf that has a partner in the reference
  const char* GetOverlapOf() const { return this->OverlapOf.c_str(); } ///< "the volume"
  ///@}

  ///@{
  /** After the last step of an alignment. */
  vtkGetMacro(Information, double);       ///< mutual information, nats; more is better
  vtkGetMacro(InformationBefore, double); ///< at the start, on the same level
  vtkGetMacro(Shift, double);             ///< of the middle of the compared tissue, mm
  vtkGetMacro(Rotation, double);          ///< degrees, 0 or more
  ///@}

  ///@{
  /** After the last step of a refinement. */
  vtkGetMacro(Cost, double);          ///< of this level, 0 or more; 0: the volumes match
  vtkGetMacro(CostBefore, double);    ///< at the start, on the same level
  vtkGetMacro(LongestMove, double);   ///< of a control point in the last step, mm
  vtkGetMacro(StepFraction, double);  ///< smallest one that the fold guard allowed, 0 to 1
  vtkGetMacro(LargestChange, double); ///< of a control point since the start, mm
  vtkGetMacro(MeanChange, double);    ///< of the control points since the start, mm
  ///@}

  /** The motion of the reference since the start: 4 x 4 numbers (mm, world axes), by rows. */
  vtkDoubleArray* GetMotion();

  /** Rotation (degrees about x, y, z) and translation (mm) that the Compare Volumes needs. */
  vtkDoubleArray* GetPlacement();

  /** The control points: 3 numbers each (mm, world axes), x fastest. */
  vtkDoubleArray* GetControlPoints();

protected:
  vtkRegistrationRun();
  ~vtkRegistrationRun() override;

private:
  vtkRegistrationRun(const vtkRegistrationRun&) = delete;
  void operator=(const vtkRegistrationRun&) = delete;

  void Begin(bool bends); // throws a Problem
  void BeginGuarded(bool bends);
  void Advance();
  void Report();
  void ReportChecks();
  void Warn(const std::string& sentence);
  void ReportAlignment();
  void ReportRefinement();

  vtkWeakPointer<vtkAlgorithm> Source;
  int Similarity = 0;
  double Stiffness = 1.0;
  int KeepFailed = 0;
  int Starts = 1;
  double StartRotation[3] = { 0.0, 0.0, 0.0 };
  double StartTranslation[3] = { 0.0, 0.0, 0.0 };

  std::string SimilarityNames;
  std::string SimilarityLabels;
  std::string SimilarityTooltips;
  std::string Problem;
  std::string Refusal;
  std::string Warning;
  std::string Trust = "unchecked";
  std::string OverlapOf = "the volume";
  int Finished = 0;
  int Checking = 0;
  int Steps = 0;
  int Level = 0;
  double Done = 0.0;
  double Overlap = 0.0;
  double Information = 0.0;
  double InformationBefore = 0.0;
  double Shift = 0.0;
  double Rotation = 0.0;
  double Cost = 0.0;
  double CostBefore = 0.0;
  double LongestMove = 0.0;
  double StepFraction = 1.0;
  double LargestChange = 0.0;
  double MeanChange = 0.0;
  vtkNew<vtkDoubleArray> Motion;
  vtkNew<vtkDoubleArray> Placement;
  vtkNew<vtkDoubleArray> ControlPoints;

  struct Running;
  std::unique_ptr<Running> Internal;
};

#endif

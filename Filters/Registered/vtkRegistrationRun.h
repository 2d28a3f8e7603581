// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkRegistrationRun
 * @brief   aligns a reference or refines a bend, a short part for each call
 *
 * The volumes may lie on a server. This object lives beside them, and the XML proxy of the same
 * name brings its figures to the client. It changes nothing in the pipeline: whoever runs it sets
 * what it found. Begin with BeginAlignment or BeginRefinement, then call Step until it is finished
 * or enough. All numbers are mm.
 */
#ifndef vtkRegistrationRun_h
#define vtkRegistrationRun_h

#include "vtkBrainShiftFiltersModule.h" // for the export macro
#include "vtkNew.h"                     // for answers
#include "vtkObject.h"
#include "vtkWeakPointer.h" // for what is registered

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

  /** What is registered: a Compare Volumes that is up to date, or what hands on its output. */
  void SetSource(vtkAlgorithm* source);

  ///@{
  /**
   * What agreement means for a refinement. 0: self-similarity, for any contrast (default); 1: local
   * correlation, for the same contrast; 2: LC2, for ultrasound.
   */
  vtkSetClampMacro(Similarity, int, 0, 2);
  vtkGetMacro(Similarity, int);
  ///@}

  ///@{
  /** Factor on what bending costs in a refinement; above 0. Default 1. */
  vtkSetMacro(Stiffness, double);
  vtkGetMacro(Stiffness, double);
  ///@}

  ///@{
  /** Begins anew, from where the reference lies or from how the volume is bent. */
  void BeginAlignment();
  void BeginRefinement();
  ///@}

  /**
   * Takes one step; a refinement may try a length of it, or prepare a part of its next level.
   * Nothing once it is finished, or without a beginning.
   */
  void Step();

  /** Why it could not begin: a sentence without a full stop. Empty if it could. */
  const char* GetProblem() const { return this->Problem.c_str(); }

  /**
   * Nine figures after the last step:
   * 0. 1 if it is finished, else 0
   * 1. steps taken
   * 2. level, from 0 on
   * 3. share of the volume that has a partner in the reference, 0 to 1; by ultrasound, the share of
   *    what the sweep saw that is compared
   * 4. alignment: mutual information (nats); refinement: disagreement, 0 or more
   * 5. the same at the beginning, on the same level
   * 6. alignment: shift so far (mm); refinement: longest way of a control point in the step (mm)
   * 7. alignment: turn so far (degrees); refinement: smallest share that the fold guard left
   * 8. refinement: share of the most steps there may be, 0 to 1; alignment: 0 until it is finished
   */
  vtkDoubleArray* GetFigures();

  /** How to move the reference from where it was: 4 x 4 numbers (mm), row after row. */
  vtkDoubleArray* GetMotion();

  /** The control points of the bend: 3 numbers each (mm, world axes), x fastest. */
  vtkDoubleArray* GetControlPoints();

protected:
  vtkRegistrationRun();
  ~vtkRegistrationRun() override;

private:
  vtkRegistrationRun(const vtkRegistrationRun&) = delete;
  void operator=(const vtkRegistrationRun&) = delete;

  std::string Begin(bool bends);

  vtkWeakPointer<vtkAlgorithm> Source;
  int Similarity = 0;
  double Stiffness = 1.0;
  std::string Problem;
  vtkNew<vtkDoubleArray> Figures;
  vtkNew<vtkDoubleArray> Motion;
  vtkNew<vtkDoubleArray> ControlPoints;

  struct Running;
  std::unique_ptr<Running> Internal;
};

#endif

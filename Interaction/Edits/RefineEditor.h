// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Refines a Free-Form Deformation so that its volume matches a reference, with a picture after
/// each step. It starts from the present base and strokes.
#ifndef BrainShift_RefineEditor_h
#define BrainShift_RefineEditor_h

#include "Interaction/Edits/LiveRun.h"
#include "Interaction/Workarounds/Selections.h"

#include <QJsonObject>
#include <QList>
#include <QPointer>

#include <optional>

class pqPipelineSource;

namespace brainshift
{
/// The settings of a refinement.
struct RefineSettings
{
  pqPipelineSource* reference = nullptr; ///< a Compare Volumes of the deformation, or a volume
  pqPipelineSource* cavity = nullptr;    ///< null: none, or that of the Compare Volumes
  int similarity = 0;                    ///< its index in similaritiesFor
  double stiffness = 1.0;                ///< factor on the stiffness; above 0
};

/// A similarity as the server lists it.
struct SimilarityChoice
{
  QString label;
  QString tooltip; ///< use and method
};

/// The similarities that a refinement of a source may use.
QList<SimilarityChoice> similaritiesFor(pqPipelineSource* source);

/// Whether a source is a Compare Volumes.
bool isComparison(pqPipelineSource* source);

/// The Compare Volumes that show a deformation, the nearest first.
QList<pqPipelineSource*> comparisonsOf(pqPipelineSource* deformation);

/// The figures after a step. Costs are those of the level; 0: the volumes match.
struct RefineFigures
{
  int steps = 0;
  double done = 0.0;    ///< fraction of the most steps there may be, 0 to 1
  double overlap = 0.0; ///< fraction of `overlapOf` that has a partner in the reference, 0 to 1
  QString overlapOf;    ///< in words
  double cost = 0.0;
  double costBefore = 0.0;    ///< at the start
  double stepFraction = 1.0;  ///< smallest fraction of a step that the fold guard allowed, 0 to 1
  double largestChange = 0.0; ///< of a control point since the start, mm
  double meanChange = 0.0;    ///< mm
  QString refusal;            ///< The reason to discard the result; empty if there is none.
  QString warning;            ///< What the user must check; empty if nothing.
  QString trust;              ///< "unchecked", "good", "doubtful" or "failed"
  bool isChecking = false;    ///< whether it has taken its last step and checks the result
  std::optional<double> smallestDeterminant; ///< Jacobian; known once the result was kept
};

class RefineEditor : public LiveRun
{
  Q_OBJECT

public:
  /// The editor of a Free-Form Deformation; it lives as long as the source. Null for any other
  /// source.
  static RefineEditor* of(pqPipelineSource* source);

  /// Begins a refinement. If it cannot, problem() has the reason and nothing has changed.
  void begin(const RefineSettings& settings);
  /// Stops stepping until it is called with false.
  void pause(bool on);

  const RefineFigures& figures() const { return this->Figures; }
  /// The cost after each step, as a fraction of that at the start on the same level.
  const QList<double>& costs() const { return this->Costs; }

protected:
  void takeStep() override;
  void keep(State end) override;
  void putResult() override;
  QByteArray found() const;
  void restore() override;
  void comeBack() override;
  void release() override;
  bool dependsOn(vtkObject* proxy, const char* property) const override;
  void followChange(vtkObject* proxy, const char* property) override;
  void followRemoval(pqPipelineSource* source) override;
  /// Removes the temporary lattice, unless the deformation uses it.
  void abandon(const QString& problem) override;

private:
  explicit RefineEditor(pqPipelineSource* source);

  QString beginRefinement(const RefineSettings& settings);
  void readFigures();
  void hold();
  void show();
  void putIn(vtkSMProxy* lattice, const std::vector<double>& controlPoints);
  void putBack();         ///< Restores base and strokes.
  void putBaseBack();     ///< Sets the property alone.
  void releaseHeldSoon(); ///< Releases the temporary lattice; it is deleted later.
  void stopAligning(pqPipelineSource* reference);
  void followReference(const QString& happened);
  void forgetProblemOf(pqPipelineSource* source);
  vtkSmartPointer<vtkSMProxy> lattice() const;

  RefineFigures Figures;
  QList<double> Costs;
  QJsonObject Compared;       ///< What it is made of.
  vtkTypeUInt32 Deleted = 0;  ///< Global number of the reference whose deletion ended it; 0: none.
  std::vector<double> Start;  ///< Control points: 3 numbers each (mm, world axes), x fastest.
  std::vector<double> Points; ///< The same, after the last step.

  // While it is active:
  vtkWeakPointer<vtkSMProxy> Held;      ///< The temporary Refined Lattice.
  vtkSmartPointer<vtkSMProxy> Base;     ///< The Lattice at the start; null: none.
  std::vector<double> Strokes;          ///< Those at the start.
  QPointer<pqPipelineSource> Reference; ///< Its deletion ends the run.
  bool IsDrawn = true;                  ///< Whether the last step is.
  EmptySelections Unselected;
};
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Bends a Free-Form Deformation until its volume agrees with a reference: a part of a step for
/// each turn of the event loop, beside the data, with a picture after each step. It begins with
/// what is there, base and strokes. The undo stack sees nothing of it until the result is kept, as
/// one step.
#ifndef BrainShift_RefineEditor_h
#define BrainShift_RefineEditor_h

#include "Interaction/Edits/RefineRun.h"
#include "Interaction/Workarounds/EmptySelections.h"

#include <vtkEventQtSlotConnect.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkWeakPointer.h>

#include <QList>
#include <QObject>
#include <QPointer>
#include <QString>
#include <QTimer>

#include <vector>

class pqPipelineSource;
class pqServer;
class vtkObject;
class vtkSMProxy;

namespace brainshift
{
class RefineEditor : public QObject
{
  Q_OBJECT

public:
  enum class State
  {
    Idle,    ///< Nothing ran yet, or the volume is as it was before.
    Running, ///< The timer takes steps.
    Paused,
    Kept,    ///< It was stopped, and what it had reached was kept.
    Finished ///< It came to its end.
  };

  /// The editor of a Free-Form Deformation; it lives as long as the source. Null for any other
  /// source.
  static RefineEditor* of(pqPipelineSource* source);

  /// Begins a refinement. If it cannot, problem() says why and nothing has changed.
  void begin(const RefineSettings& settings);
  /// Takes no step until it is called with false.
  void pause(bool on);
  /// Ends it and keeps what was reached: one undo step, none if nothing has changed.
  void stop() { this->keep(State::Kept); }
  /// Ends it and restores base and strokes. The undo stack sees nothing.
  void cancel();

  State state() const { return this->Now; }
  bool isActive() const { return this->Now == State::Running || this->Now == State::Paused; }
  const RefineFigures& figures() const { return this->Run.figures(); }
  /// The disagreement after each step, as a share of that of the beginning on the same level.
  const QList<double>& shares() const { return this->Run.shares(); }
  /// Why it could not begin or why it ended early: a sentence. Empty if neither happened.
  const QString& problem() const { return this->Problem; }

  /// While it runs, Escape restores what was there before, wherever the keyboard is.
  bool eventFilter(QObject* watched, QEvent* event) override;

Q_SIGNALS:
  /// State, figures or problem changed.
  void changed();

private Q_SLOTS:
  void notice(vtkObject* proxy, unsigned long event, void* clientData, void* name);

private:
  explicit RefineEditor(pqPipelineSource* source);

  void followApplication();
  void hold();
  void step();
  void show();
  void keep(State end);
  void putIn(vtkSMProxy* lattice, const std::vector<double>& controlPoints);
  void restore();   ///< What was there before, and nothing of the run.
  void putBack();   ///< Base and strokes.
  void leaveHeld(); ///< The lattice for now goes soon.
  void forget(State end);
  void abandon(const QString& problem);
  vtkSmartPointer<vtkSMProxy> makeLattice() const;
  vtkSmartPointer<vtkSMProxy> lattice() const;

  pqPipelineSource* Source;
  vtkNew<vtkEventQtSlotConnect> OfSource;
  QTimer Next; ///< Takes the next step.
  State Now = State::Idle;
  RefineRun Run;
  QString Problem;

  // While it is active:
  vtkWeakPointer<vtkSMProxy> Held;      ///< The Refined Lattice that is drawn for now.
  vtkSmartPointer<vtkSMProxy> Base;     ///< The Lattice from before; null: none.
  std::vector<double> Strokes;          ///< Those from before.
  QPointer<pqPipelineSource> Reference; ///< It ends when this goes.
  bool IsDrawn = true;                  ///< The last step.
  EmptySelections Unselected;
  bool Writing = false; ///< This editor changes something right now.
};
}

#endif

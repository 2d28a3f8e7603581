// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Moves the reference of a Compare Volumes to where it says most about the volume: a few lines of
/// the search for each turn of the event loop, beside the data, with a picture after each. The undo
/// stack sees nothing of it until the result is kept, as one step.
#ifndef BrainShift_AlignEditor_h
#define BrainShift_AlignEditor_h

#include "Interaction/Edits/AlignRun.h"

#include <vtkEventQtSlotConnect.h>
#include <vtkNew.h>

#include <QList>
#include <QObject>
#include <QString>
#include <QTimer>

class pqPipelineSource;
class vtkObject;

namespace brainshift
{
class AlignEditor : public QObject
{
  Q_OBJECT

public:
  enum class State
  {
    Idle,    ///< Nothing ran yet, or the reference lies where it lay before.
    Running, ///< The timer searches.
    Kept,    ///< It was stopped, and what it had reached was kept.
    Finished ///< It came to its end.
  };

  /// The editor of a Compare Volumes; it lives as long as the source. Null for any other source.
  static AlignEditor* of(pqPipelineSource* source);

  /// Begins an alignment. If it cannot, problem() says why and nothing has changed.
  void begin();
  /// Ends it and keeps what was reached: one undo step, none if nothing has changed.
  void stop() { this->keep(State::Kept); }
  /// Ends it and moves the reference back. The undo stack sees nothing.
  void cancel();

  State state() const { return this->Now; }
  bool isActive() const { return this->Now == State::Running; }
  const AlignFigures& figures() const { return this->Run.figures(); }
  /// Why it could not begin or why it ended early: a sentence. Empty if neither happened.
  const QString& problem() const { return this->Problem; }

  /// While it runs, Escape moves the reference back, wherever the keyboard is.
  bool eventFilter(QObject* watched, QEvent* event) override;

Q_SIGNALS:
  /// State, figures or problem changed.
  void changed();

private Q_SLOTS:
  void notice(vtkObject* proxy, unsigned long event, void* clientData, void* name);

private:
  explicit AlignEditor(pqPipelineSource* source);

  void followApplication();
  void followDeformation();
  void step();
  void put(const RigidMotion& motion);
  void keep(State end);
  void end(State end, const QString& problem);

  pqPipelineSource* Source;
  vtkNew<vtkEventQtSlotConnect> OfSource;
  QTimer Next; ///< Searches on.
  State Now = State::Idle;
  AlignRun Run;
  QString Problem;
  bool Writing = false; ///< This editor changes something right now.

  // While it is active:
  vtkNew<vtkEventQtSlotConnect> OfDeformation;
  QList<QMetaObject::Connection> Hands;
};
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A registration that runs in the window: a part of a step for each event of a timer, beside
/// the data, which may be on a server. Align and Refine differ in what a step shows, keeps and puts
/// back. The undo stack sees nothing until the result is kept, as one step.
#ifndef BrainShift_LiveRun_h
#define BrainShift_LiveRun_h

#include <vtkEventQtSlotConnect.h>
#include <vtkNew.h>
#include <vtkSMProxy.h>
#include <vtkSmartPointer.h>

#include <QObject>
#include <QString>
#include <QTimer>

#include <vector>

class pqPipelineSource;
class vtkObject;

namespace brainshift
{
/// Why a source cannot be registered as its panel shows it: the source, or a value in the panel, is
/// not applied. A sentence; empty if it can be, and for null.
QString whyUnapplied(pqPipelineSource* source);

class LiveRun : public QObject
{
  Q_OBJECT

public:
  enum class State
  {
    Idle,    ///< Nothing ran yet, or everything is restored.
    Running, ///< The timer takes steps.
    Paused,
    Kept,    ///< It was stopped, and its result so far was kept.
    Finished ///< It ended by itself, and its result was kept.
  };

  /// Ends it and keeps the result so far: one undo step, none if nothing has changed.
  void stop();
  /// Stops what runs on a pipeline source, which may be null.
  static void stopOn(pqPipelineSource* source);
  /// Ends it and restores the state before it. The undo stack sees nothing.
  void cancel(const QString& problem = {});
  /// Keeps the result that failed its checks and was discarded, as one undo step.
  void keepDiscarded();

  State state() const { return this->Now; }
  /// Whether a failed result was discarded, and can still be kept: nothing it depends on changed.
  bool hasDiscarded() const { return this->HasDiscarded; }
  bool isActive() const { return this->Now == State::Running || this->Now == State::Paused; }
  /// Why it could not begin or why it ended early: a sentence. Empty if neither happened.
  const QString& problem() const { return this->Problem; }

  /// Whether something that the kept result depends on changed since: its figures no longer hold.
  bool hasChangedSince() const { return this->HasChangedSince; }

  /// While it runs, Escape cancels it, wherever the keyboard is.
  bool eventFilter(QObject* watched, QEvent* event) override;

Q_SIGNALS:
  /// State, figures or problem changed.
  void changed();

protected Q_SLOTS:
  void notice(vtkObject* proxy, unsigned long event, void* clientData, void* name);
  /// Of a state that is being saved: it gets what was there before.
  void writeStart(vtkObject* manager, unsigned long event, void* clientData, void* saved);

protected:
  explicit LiveRun(pqPipelineSource* source);

  /// Makes a RegistrationRun of the volumes of a Compare Volumes. The caller sets its properties.
  vtkSMProxy* makeRun(vtkSMProxy* compared);
  /// Begins it by a command. Returns the reason if it cannot: a sentence; empty if it can.
  QString beginRun(const char* command);
  /// Takes a step, or a part of one. False if it failed or the server is gone.
  bool advance();
  /// Lets the RegistrationRun choose what it keeps if it ends now. False: it is gone.
  bool settle();
  /// Properties of the RegistrationRun, as of the last step.
  double figure(const char* name) const;
  QString text(const char* name) const;
  std::vector<double> numbers(const char* name) const;

  /// Starts the timer.
  void start();
  /// Why it ended no longer holds.
  void forgetProblem();
  /// Ends it; the pipeline stays as it is.
  void end(State end, const QString& problem);
  /// Restores the state before it, as cancel() does. A result that failed its checks can be kept.
  void discard(const QString& reason);
  /// Connects the properties of a proxy to notice(), until the next run begins. Null has none.
  void watch(vtkSMProxy* proxy);

  /// Takes a step and shows it. Starts `Next`, unless it ended.
  virtual void takeStep() = 0;
  /// Keeps the result so far, then ends.
  virtual void keep(State end) = 0;
  /// Writes the last result, as one undo step.
  virtual void putResult() = 0;
  /// Restores the state before it.
  virtual void restore() = 0;
  /// Shows the last step again, after restore() for a state file: it must not lose the start.
  virtual void comeBack() = 0;
  /// Releases the members that are used while it is active.
  virtual void release() = 0;
  /// Whether the result depends on a property: of the source, or of another proxy that it watches.
  virtual bool dependsOn(vtkObject* proxy, const char* property) const = 0;
  /// Such a property changed from outside while it is active.
  virtual void followChange(vtkObject* proxy, const char* property) = 0;
  /// A source is about to be deleted.
  virtual void followRemoval(pqPipelineSource* source) = 0;
  /// Ends it; properties that were changed from outside stay.
  virtual void abandon(const QString& problem) { this->end(State::Idle, problem); }

  pqPipelineSource* Source;
  QTimer Next; ///< Takes the next step.
  State Now = State::Idle;
  QString Problem;
  bool Writing = false; ///< This run is changing a property.

private:
  void followApplication();
  void standAside();

  bool IsAside = false; ///< The start is restored for a state, until the next event.
  bool HasDiscarded = false;
  bool HasChangedSince = false;

  vtkNew<vtkEventQtSlotConnect> OfSource;
  vtkNew<vtkEventQtSlotConnect> OfOthers; // what else the result depends on
  vtkSmartPointer<vtkSMProxy> Proxy;
};
}

#endif

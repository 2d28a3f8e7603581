// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The live pointer of the window: takes the poses of a tool from a server or a recorded session,
/// places them in the image, draws the tip, gets its distance to the deformed cortex and records
/// traces. There is one hand with a pointer, so there is one object.
#ifndef BrainShift_Pointer_h
#define BrainShift_Pointer_h

#include "Interaction/Pointer/PointerTrace.h"
#include "Interaction/Pointer/TipDistance.h"
#include "Interaction/Pointer/TipDrawing.h"
#include "Interaction/Pointer/TrackerRegistration.h"
#include "Tracking/SessionFile.h"
#include "Tracking/TrackerClient.h"

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>

class pqPipelineSource;

namespace brainshift
{
class Pointer : public QObject
{
  Q_OBJECT

public:
  /// After so many seconds a pose is old: trackers send 20 a second or more. No tip is shown then.
  static constexpr double OldSeconds = 0.5;

  /// The pointer of this window; it goes when the application quits.
  static Pointer* instance();
  ~Pointer() override;

  /// Starts to receive from a server. It returns at once; state() reports the connection.
  void open(const TrackerOptions& options);
  /// Plays a recorded session. Returns one sentence if the file cannot be read.
  QString replay(const QString& path);
  /// Stops receiving or replaying. The recorded poses can still be saved.
  void close();
  /// Whether a server is connected or retried, or a session is replayed.
  bool isOpen() const { return this->Source && this->State.phase != SourceState::Phase::Ended; }
  bool isReplay() const { return this->Replayed; }
  const SourceState& state() const { return this->State; }
  /// Seconds since the last pose. None before the first.
  std::optional<double> age() const;

  /// The tip (mm, world) while the tool is seen. Without a registration the tracker's frame is
  /// taken as the image's.
  const std::optional<glm::dvec3>& tip() const { return this->Tip; }
  /// Signed distance of the tip to the deformed cortex (mm, positive outside).
  const std::optional<double>& distance() const { return this->Distance; }
  const QString& distanceProblem() const { return this->Cortex.problem(); }

  /// The scalar value at the cortex of the active Free-Form Deformation. A Trace Distance or a fit
  /// that has one takes precedence. Default: the middle of its range.
  void setThreshold(double threshold);
  double threshold() const;
  /// Whether setThreshold() counts.
  bool needsThreshold() const;

  TrackerRegistration& registration() { return this->Registration; }
  /// Adds the mean of the tips of the last 0.5 s as a touched landmark. Returns one sentence if the
  /// tool was not seen, or did not rest.
  QString touch();

  /// Begins or ends a trace. Returns one sentence if it cannot begin.
  QString record(bool on);
  const PointerTrace& trace() const { return this->Trace; }

  /// All poses since it was opened, MostPoses at most, as a file. Returns one sentence if it cannot
  /// be written.
  QString saveSession(const QString& path);
  bool hasSession() const { return !this->Recorded.poses.empty(); }
  /// Whether it has MostPoses: it keeps no further ones.
  bool isSessionFull() const { return this->Recorded.poses.size() >= MostPoses; }
  /// Whether a server sent poses that are not saved. open() and replay() drop them.
  bool hasUnsaved() const { return this->Unsaved; }

  /// Records while the key for it is held.
  bool eventFilter(QObject* watched, QEvent* event) override;

Q_SIGNALS:
  /// Something that the panel shows is new.
  void changed();
  /// The key that records was handled. `problem`: one sentence if it failed, else empty.
  void recordHandled(const QString& problem);

private:
  explicit Pointer(QObject* parent);

  void start(std::unique_ptr<PoseSource> source);
  void forget(pqPipelineSource* source);
  void drain();
  void updateTip();
  void show();

  std::unique_ptr<PoseSource> Source;
  bool Replayed = false;
  SourceState State;
  Session Recorded; // poses of the tracker
  bool Unsaved = false;
  std::optional<Pose> Newest;
  std::optional<glm::dvec3> Tip;
  std::optional<double> Distance;
  TrackerRegistration Registration;
  std::optional<TrackerRegistration> Own; ///< Since a replay: that of the live tracker.
  std::deque<Pose> Last;                  ///< Those that a touch takes the mean of.
  PointerTrace Trace;
  bool HeldByKey = false; ///< The key began the trace, so its release ends it.
  TipDistance Cortex;
  TipDrawing Drawing;
  QTimer Draining;
  QElapsedTimer SinceDrawn;
  QElapsedTimer SinceBent; ///< Since the last fit began.
  qint64 BendAfterMs = 0;  ///< Least time from the begin of one fit to that of the next.
};
}

#endif

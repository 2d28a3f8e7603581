// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Pointer/Pointer.h"

#include "Interaction/Commands/Application.h"
#include "Interaction/Commands/Commands.h"
#include "Interaction/Views/ActiveDeformation.h"

#include <pqPipelineSource.h>
#include <pqRenderView.h>
#include <vtkSMProxy.h>
#include <vtkSMSession.h>

#include <QApplication>
#include <QKeyEvent>

#include <algorithm>
#include <utility>

namespace brainshift
{
namespace
{
constexpr int DrainEachMs = 10; // trackers send up to 100 poses a second, most of them 60
constexpr int DrawEachMs = 30;  // leaves time for the rest of the window
constexpr int BendEachMs = 100; // a solve of a long trace takes about that long
constexpr double TouchSeconds = 0.5;
constexpr double StillMm = 2.0; // a hand at rest on a landmark
constexpr int LeastTouches = 5;
constexpr const char* ThresholdName = "BrainShiftCortex"; // of a source: it goes with its volume

// Whether the pipeline runs right now. ParaView 6.1 lets timers run meanwhile.
bool isExecuting(pqPipelineSource* source)
{
  return source && source->getProxy()->GetSession()->GetPendingProgress();
}
}

Pointer* Pointer::instance()
{
  static QPointer<Pointer> pointer = new Pointer(qApp);
  return pointer;
}

Pointer::Pointer(QObject* parent)
  : QObject(parent)
{
  this->State.phase = SourceState::Phase::Ended;
  this->Draining.setTimerType(Qt::PreciseTimer);
  this->Draining.setInterval(DrainEachMs);
  QObject::connect(&this->Draining, &QTimer::timeout, this, &Pointer::drain);
  pqServerManagerModel* model = serverManagerModel();
  // Nothing of a source or a view may stay in hand when it goes.
  QObject::connect(model, &pqServerManagerModel::preSourceRemoved, this, &Pointer::forget);
  // Before any proxy goes: a trace that ends makes some.
  QObject::connect(
    model, &pqServerManagerModel::aboutToRemoveServer, this, [this] { this->close(); });
  QObject::connect(model, &pqServerManagerModel::preViewRemoved, this, [this](pqView* view) {
    if (auto render = qobject_cast<pqRenderView*>(view))
    {
      this->Drawing.leave(render);
    }
  });
  QObject::connect(qApp, &QCoreApplication::aboutToQuit, this, [this] { this->close(); });
}

Pointer::~Pointer() = default;

void Pointer::forget(pqPipelineSource* source)
{
  if (this->Trace.isRecording() && source == this->Trace.deformation())
  {
    this->HeldByKey = false;
    this->Trace.abandon(); // nothing may be made for what goes
    this->Drawing.setTrace({});
  }
  this->Cortex.forget();
}

void Pointer::open(const TrackerOptions& options)
{
  this->start(std::make_unique<TrackerClient>(options));
}

QString Pointer::replay(const QString& path)
{
  Session session;
  const std::string problem = readSession(path.toStdString(), session);
  if (!problem.empty())
  {
    return QString::fromStdString(problem) + ".";
  }
  const std::optional<Placement> placement = session.placement;
  this->start(std::make_unique<Replay>(std::move(session)));
  this->Replayed = true;
  this->Recorded.placement = placement;
  this->Own = std::exchange(this->Registration, {}); // the live tracker gets it back
  if (placement)
  {
    this->Registration.take({ placement->rotation, placement->translation });
  }
  return {};
}

void Pointer::start(std::unique_ptr<PoseSource> source)
{
  this->close();
  if (this->Own)
  {
    this->Registration = std::move(*this->Own);
    this->Own.reset();
  }
  this->Source = std::move(source);
  this->State = this->Source->state();
  this->Replayed = false;
  this->Recorded = {};
  this->Unsaved = false;
  this->Last.clear();
  this->Draining.start();
  qApp->installEventFilter(this);
  Q_EMIT this->changed();
}

void Pointer::close()
{
  qApp->removeEventFilter(this);
  this->record(false);
  this->Draining.stop();
  this->Source.reset();
  this->Newest.reset();
  this->Tip.reset();
  this->Distance.reset();
  this->State = {};
  this->State.phase = SourceState::Phase::Ended;
  this->Drawing.leaveAll();
  this->Cortex.forget();
  Q_EMIT this->changed();
}

std::optional<double> Pointer::age() const
{
  return this->Source && this->State.lastSeconds >= 0.0
    ? std::optional<double>(this->Source->now() - this->State.lastSeconds)
    : std::nullopt;
}

void Pointer::setThreshold(double threshold)
{
  if (pqPipelineSource* deformation = activeDeformation())
  {
    deformation->setProperty(ThresholdName, threshold);
  }
}

double Pointer::threshold() const
{
  pqPipelineSource* deformation = activeDeformation();
  const QVariant set = deformation ? deformation->property(ThresholdName) : QVariant();
  return set.isValid() ? set.toDouble() : deformation ? halfwayThreshold(deformation) : 0.5;
}

bool Pointer::needsThreshold() const
{
  pqPipelineSource* deformation = activeDeformation();
  return deformation && !cortexOf(deformation);
}

void Pointer::drain()
{
  if (!this->Source)
  {
    return;
  }
  const std::vector<Pose> poses = this->Source->take();
  this->State = this->Source->state();
  this->Unsaved = this->Unsaved || !(poses.empty() || this->Replayed);
  const RigidPose& placed = this->Registration.imageFromTracker();
  for (const Pose& pose : poses)
  {
    if (this->Trace.isRecording())
    {
      this->Trace.add(placed.apply(pose.tip));
    }
    this->Last.push_back(pose);
    while (this->Last.front().seconds < pose.seconds - TouchSeconds)
    {
      this->Last.pop_front();
    }
    if (this->Recorded.poses.size() < MostPoses)
    {
      this->Recorded.poses.push_back(pose);
    }
    this->Newest = pose;
  }
  if (isExecuting(activeDeformation()))
  {
    return; // the poses are kept, and the next call draws
  }
  if (!this->SinceDrawn.isValid() || this->SinceDrawn.elapsed() >= DrawEachMs)
  {
    this->show();
    this->SinceDrawn.start();
  }
  if (this->State.phase == SourceState::Phase::Ended)
  {
    // The sentence and the recorded poses stay.
    this->Draining.stop();
    this->record(false);
    qApp->removeEventFilter(this);
    this->show();
    this->Drawing.leaveAll();
    this->Cortex.forget();
  }
}

void Pointer::updateTip()
{
  if (!this->Newest || !this->State.visible || !this->isOpen() ||
    this->age().value_or(0.0) > OldSeconds)
  {
    this->Tip.reset();
    this->Distance.reset();
    this->Drawing.hide();
    return;
  }
  const RigidPose& placed = this->Registration.imageFromTracker();
  const glm::dvec3 tip = placed.apply(this->Newest->tip);
  this->Tip = tip;
  pqPipelineSource* deformation = activeDeformation();
  const bool applied = deformation && deformation->modifiedState() != pqProxy::UNINITIALIZED;
  this->Distance = applied ? this->Cortex.of(deformation, tip, this->threshold()) : std::nullopt;
  this->Drawing.setBending(this->Trace.isRecording());
  // Nothing but the drawing of the shaft depends on this axis.
  this->Drawing.show(tip, glm::normalize(placed.rotation * this->Newest->rotation[2]));
}

void Pointer::show()
{
  if (this->Trace.isRecording() &&
    (!this->SinceBent.isValid() || this->SinceBent.elapsed() >= this->BendAfterMs))
  {
    this->SinceBent.start();
    this->Trace.fit();
    this->Drawing.setTrace(this->Trace.points());
    // On a slow machine, three quarters of the time are left for the tip.
    this->BendAfterMs = std::max<qint64>(BendEachMs, 4 * this->SinceBent.elapsed());
  }
  this->updateTip();
  Q_EMIT this->changed();
}

QString Pointer::touch()
{
  glm::dvec3 mean(0.0);
  std::vector<glm::dvec3> tips;
  for (auto pose = this->Last.rbegin(); pose != this->Last.rend() && this->Source; ++pose)
  {
    if (pose->seconds < this->Source->now() - TouchSeconds)
    {
      break;
    }
    tips.push_back(pose->tip);
    mean += pose->tip;
  }
  if (tips.size() < LeastTouches || !this->State.visible)
  {
    return tr("The tool was not visible for half a second.");
  }
  mean /= static_cast<double>(tips.size());
  for (const glm::dvec3& tip : tips)
  {
    if (glm::distance(tip, mean) > StillMm)
    {
      return tr("The tip moved more than %1 mm. Hold it still for half a second.").arg(StillMm);
    }
  }
  this->Registration.touch(mean);
  Q_EMIT this->changed();
  return {};
}

QString Pointer::record(bool on)
{
  if (on == this->Trace.isRecording())
  {
    return {};
  }
  QString problem;
  if (on)
  {
    pqPipelineSource* deformation = activeDeformation();
    problem = !this->isOpen() ? tr("Connect a pointer first.")
      : !deformation          ? tr("Select a Free-Form Deformation to edit.")
                              : this->Trace.begin(deformation, this->threshold());
  }
  else
  {
    this->HeldByKey = false;
    this->Trace.end();
    this->Drawing.setTrace({}); // its source is shown now
  }
  Q_EMIT this->changed();
  return problem;
}

QString Pointer::saveSession(const QString& path)
{
  Session session = this->Recorded;
  if (!this->Replayed && this->Registration.isRegistered())
  {
    const RigidPose& placed = this->Registration.imageFromTracker();
    session.placement = Placement{ placed.rotation, placed.translation };
  }
  const std::string problem = writeSession(path.toStdString(), session);
  this->Unsaved = this->Unsaved && !problem.empty();
  return problem.empty() ? QString() : QString::fromStdString(problem) + ".";
}

bool Pointer::eventFilter(QObject* watched, QEvent* event)
{
  const QEvent::Type type = event->type();
  if (type == QEvent::ApplicationDeactivate && this->HeldByKey)
  {
    this->record(false); // another window receives the key's release
  }
  if (type != QEvent::KeyPress && type != QEvent::KeyRelease && type != QEvent::ShortcutOverride)
  {
    return QObject::eventFilter(watched, event);
  }
  auto key = static_cast<QKeyEvent*>(event);
  const KeyCommand found = commandOfKey({ Scope::Window }, key->key());
  const bool begins = key->modifiers() == Qt::NoModifier && !isTyping();
  if (found.command != Command::RecordTrace || !(begins || this->HeldByKey))
  {
    return QObject::eventFilter(watched, event);
  }
  if (type == QEvent::ShortcutOverride)
  {
    event->accept(); // or a shortcut of the window comes first
  }
  else if (type == QEvent::KeyPress && !key->isAutoRepeat() && !this->Trace.isRecording())
  {
    const QString problem = this->record(true);
    this->HeldByKey = this->Trace.isRecording();
    Q_EMIT this->recordHandled(problem);
  }
  else if (type == QEvent::KeyRelease && !key->isAutoRepeat() && this->HeldByKey)
  {
    Q_EMIT this->recordHandled(this->record(false));
  }
  return true;
}
}

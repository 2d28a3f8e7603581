// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Edits/AlignEditor.h"

#include "Interaction/Edits/FitEditor.h"
#include "Interaction/Edits/LivePicture.h"
#include "Interaction/Edits/RefineEditor.h"
#include "Interaction/Edits/StrokeEditor.h"
#include "Interaction/Views/ActiveDeformation.h"

#include <pqApplicationCore.h>
#include <pqPipelineSource.h>
#include <pqServer.h>
#include <pqServerManagerModel.h>
#include <pqUndoStack.h>

#include <vtkCommand.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMTrace.h>

#include <QApplication>
#include <QElapsedTimer>
#include <QKeyEvent>
#include <QScopedValueRollback>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <iterator>

namespace brainshift
{
namespace
{
constexpr qint64 SearchMs = 40; // between two pictures: Stop is answered soon after

// As in brainshift.align of Python and in Filters/Register/Alignment.cxx.
constexpr double LeastCompared = 0.25;

constexpr const char* Motion[] = { "ReferenceRotation", "ReferenceTranslation" };
// What an alignment stands on. Whoever changes one of these in the meantime ends it.
constexpr const char* Ground[] = { "Input", "Reference", "Cavity", "CavityLabels" };
// Beside the settings of the lattice.
constexpr const char* GroundOfDeformation[] = { "Input", "Lattice", "Strokes", "Strength",
  "Inverse" };

template <std::size_t Count>
bool isAmong(const char* const (&names)[Count], const char* name)
{
  return std::any_of(std::begin(names), std::end(names),
    [name](const char* known) { return std::strcmp(known, name) == 0; });
}
}

AlignEditor* AlignEditor::of(pqPipelineSource* source)
{
  if (!isComparison(source))
  {
    return nullptr;
  }
  auto editor = source->findChild<AlignEditor*>(QString(), Qt::FindDirectChildrenOnly);
  return editor ? editor : new AlignEditor(source);
}

AlignEditor::AlignEditor(pqPipelineSource* source)
  : QObject(source)
  , Source(source)
{
  this->Next.setSingleShot(true);
  this->Next.setInterval(0);
  this->connect(&this->Next, &QTimer::timeout, this, &AlignEditor::step);
  this->OfSource->Connect(source->getProxy(), vtkCommand::PropertyModifiedEvent, this,
    SLOT(notice(vtkObject*, unsigned long, void*, void*)));
  this->followApplication();
}

void AlignEditor::followApplication()
{
  this->connect(qApp, &QCoreApplication::aboutToQuit, this, [this] { this->end(State::Idle, {}); });
  pqServerManagerModel* model = pqApplicationCore::instance()->getServerManagerModel();
  this->connect(model, &pqServerManagerModel::preSourceRemoved, this, [this](auto* source) {
    if (this->isActive() && source == this->Source)
    {
      this->cancel(); // undo brings it back as it was before
    }
  });
  this->connect(model, &pqServerManagerModel::preServerRemoved, this, [this](pqServer* server) {
    if (server == this->Source->getServer())
    {
      this->end(State::Idle, {}); // all proxies go
    }
  });
}

// What is compared lies where the bend puts it. A hand that begins in the meantime has its way, and
// what was reached is kept.
void AlignEditor::followDeformation()
{
  pqPipelineSource* bent = deformationUpstream(this->Source);
  if (!bent)
  {
    return;
  }
  const auto giveWay = [this](bool begins) {
    if (begins)
    {
      this->stop();
    }
  };
  this->Hands = { this->connect(StrokeEditor::of(bent), &StrokeEditor::editing, this, giveWay),
    this->connect(FitEditor::of(bent), &FitEditor::editing, this, giveWay) };
  this->OfDeformation->Connect(bent->getProxy(), vtkCommand::PropertyModifiedEvent, this,
    SLOT(notice(vtkObject*, unsigned long, void*, void*)));
}

void AlignEditor::begin()
{
  this->cancel();
  if (pqPipelineSource* bent = deformationUpstream(this->Source))
  {
    StrokeEditor::of(bent)->cancel();
    FitEditor::of(bent)->cancel();
    RefineEditor::of(bent)->stop();
  }
  const QString problem = this->Run.begin(this->Source);
  if (!problem.isEmpty())
  {
    this->end(State::Idle, problem);
    return;
  }
  this->Problem = QString();
  this->followDeformation();
  this->Now = State::Running;
  qApp->installEventFilter(this);
  this->Next.start();
  Q_EMIT this->changed();
}

void AlignEditor::put(const RigidMotion& motion)
{
  const QScopedValueRollback<bool> writing(this->Writing, true);
  vtkSMProxy* compare = this->Source->getProxy();
  vtkSMPropertyHelper(compare, Motion[0]).Set(&motion.rotation[0], 3);
  vtkSMPropertyHelper(compare, Motion[1]).Set(&motion.translation[0], 3);
  compare->UpdateVTKObjects();
}

void AlignEditor::step()
{
  if (!this->isActive())
  {
    return;
  }
  QElapsedTimer since;
  since.start();
  do
  {
    if (!this->Run.step())
    {
      this->cancel();
      this->Problem = tr("Align failed, see the messages. The reference lies where it lay before.");
      Q_EMIT this->changed();
      return;
    }
  } while (this->figures().done < 1.0 && since.elapsed() < SearchMs);
  {
    SCOPED_UNDO_EXCLUDE();
    this->put(this->Run.motion());
  }
  drawMoving(this->Source);
  if (!this->isActive())
  {
    return; // a picture may have let something else happen
  }
  if (this->figures().done >= 1.0)
  {
    this->keep(State::Finished);
    return;
  }
  this->Next.start();
  Q_EMIT this->changed();
}

void AlignEditor::keep(State end)
{
  if (!this->isActive())
  {
    return;
  }
  const RigidMotion before = this->Run.start();
  const bool hasBegun = this->figures().lines > 0;
  const RigidMotion found = hasBegun ? this->Run.motion() : before;
  {
    // What undo comes back to is what the session saw last, so it sees the beginning once more.
    SCOPED_UNDO_EXCLUDE();
    this->put(before);
  }
  if (hasBegun && this->figures().compared < LeastCompared)
  {
    this->end(State::Idle,
      tr("%1 % of the volume lies within the reference; at least %2 % must. The reference lies "
         "where it lay before. Move it closer first.")
        .arg(100.0 * this->figures().compared, 0, 'f', 0)
        .arg(100.0 * LeastCompared, 0, 'f', 0));
    return;
  }
  if (found.rotation != before.rotation || found.translation != before.translation)
  {
    SCOPED_UNDO_SET(tr("Align"));
    SM_SCOPED_TRACE(PropertiesModified).arg("proxy", this->Source->getProxy());
    this->put(found);
  }
  this->end(end, {});
}

void AlignEditor::cancel()
{
  if (this->isActive())
  {
    SCOPED_UNDO_EXCLUDE();
    this->put(this->Run.start());
    this->end(State::Idle, {});
  }
}

void AlignEditor::end(State end, const QString& problem)
{
  qApp->removeEventFilter(this);
  this->Next.stop();
  this->OfDeformation->Disconnect();
  for (const QMetaObject::Connection& hand : this->Hands)
  {
    QObject::disconnect(hand);
  }
  this->Hands.clear();
  this->Run.end();
  this->Now = end;
  this->Problem = problem;
  drawFully(this->Source);
  Q_EMIT this->changed();
}

void AlignEditor::notice(vtkObject* proxy, unsigned long, void*, void* name)
{
  const auto* property = static_cast<const char*>(name);
  const bool isOwn = proxy == this->Source->getProxy();
  const bool isMotion = isOwn && isAmong(Motion, property);
  const bool isGround = isOwn ? isAmong(Ground, property)
                              : isAmong(GroundOfDeformation, property) ||
      isLatticeSetting(vtkSMProxy::SafeDownCast(proxy), property);
  if (!this->isActive() || this->Writing || (!isMotion && !isGround))
  {
    return;
  }
  if (isMotion)
  {
    // What somebody else wants stands; the other of the two goes back.
    SCOPED_UNDO_EXCLUDE();
    RigidMotion wanted = this->Run.start();
    const RigidMotion now = motionOf(this->Source->getProxy());
    (std::strcmp(property, Motion[0]) == 0 ? wanted.rotation : wanted.translation) =
      std::strcmp(property, Motion[0]) == 0 ? now.rotation : now.translation;
    this->put(wanted);
    this->end(State::Idle, tr("%1 was changed, so Align ended.").arg(QString(property)));
    return;
  }
  this->cancel();
  this->Problem = tr("%1 was changed, so Align ended. The reference lies where it lay before.")
                    .arg(QString(property));
  Q_EMIT this->changed();
}

bool AlignEditor::eventFilter(QObject* watched, QEvent* event)
{
  const bool isKey = event->type() == QEvent::ShortcutOverride || event->type() == QEvent::KeyPress;
  if (isKey && static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape && this->isActive() &&
    !QApplication::activeModalWidget() && !QApplication::activePopupWidget())
  {
    if (event->type() == QEvent::KeyPress)
    {
      this->cancel();
    }
    event->accept(); // or a shortcut of the window comes first
    return true;
  }
  return QObject::eventFilter(watched, event);
}
}

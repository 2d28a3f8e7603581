// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Cases/CaseOrders.h"

#include "Interaction/Cases/PythonCall.h"
#include "Interaction/Commands/Application.h"
#include "Interaction/Edits/LiveRun.h"
#include "Interaction/Edits/RefineEditor.h"
#include "Interaction/Edits/StrokeEditor.h"
#include "Interaction/Views/ActiveDeformation.h"

#include <pqPipelineSource.h>
#include <pqServer.h>
#include <pqView.h>

#include <vtkSMSession.h>

#include <QCoreApplication>
#include <QCursor>
#include <QEventLoop>
#include <QGuiApplication>
#include <QJsonDocument>
#include <QScopedValueRollback>
#include <QWidget>

#include <algorithm>

namespace brainshift
{
namespace
{
constexpr int QuietMs = 250; // without a change, before the case is asked again

// While Python works, which takes seconds for a fit.
class Waiting
{
public:
  Waiting() { QGuiApplication::setOverrideCursor(Qt::WaitCursor); }
  ~Waiting() { QGuiApplication::restoreOverrideCursor(); }
  Waiting(const Waiting&) = delete;
  Waiting& operator=(const Waiting&) = delete;
};

void drawAll()
{
  for (pqView* view : serverManagerModel()->findItems<pqView*>())
  {
    if (view->widget() && view->widget()->isVisible())
    {
      view->forceRender();
    }
  }
}
}

CaseOrders::CaseOrders(QObject* parent)
  : QObject(parent)
{
  this->Soon.setSingleShot(true);
  this->Soon.setInterval(QuietMs);
  this->connect(&this->Soon, &QTimer::timeout, this, &CaseOrders::refresh);
  pqServerManagerModel* model = serverManagerModel();
  const auto soon = [this] { this->refreshSoon(); };
  this->connect(model, &pqServerManagerModel::sourceAdded, this, soon);
  this->connect(model, &pqServerManagerModel::sourceRemoved, this, soon);
  this->connect(model, &pqServerManagerModel::nameChanged, this, soon);
  this->connect(model, &pqServerManagerModel::dataUpdated, this, soon);
  this->connect(model, &pqServerManagerModel::serverAdded, this, soon);
  this->connect(model, &pqServerManagerModel::serverRemoved, this, [this] {
    this->Told.remove("bent"); // numbers of another session
    this->Told.remove("comparison");
    this->Problem.clear();
    this->refreshSoon();
  });
  if (pqUndoStack* stack = pqApplicationCore::instance()->getUndoStack())
  {
    this->connect(stack, &pqUndoStack::stackChanged, this, soon); // what has no source changed, too
    const auto forget = [this] { this->Problem.clear(); };
    this->connect(stack, &pqUndoStack::undone, this, forget);
    this->connect(stack, &pqUndoStack::redone, this, forget);
  }
}

void CaseOrders::report(const QString& problem)
{
  this->Problem = problem;
  Q_EMIT this->changed();
}

void CaseOrders::setWatched(bool on)
{
  this->Watched = on;
  this->refreshSoon();
}

// As an edit of the panel: what another order reads or changes is then whole.
void CaseOrders::endEdits()
{
  if (pqPipelineSource* deformation = this->bent())
  {
    RefineEditor::of(deformation)->stop();
    // Its trial position would be that of the cavity and of what is exported.
    for (pqPipelineSource* comparison : comparisonsOf(deformation))
    {
      LiveRun::stopOn(comparison);
    }
    StrokeEditor::of(deformation)->cancel();
  }
}

void CaseOrders::give(const QString& order, const QJsonObject& arguments, const QString& label)
{
  if (order != "select" && order != "begin") // which edit no deformation
  {
    this->endEdits();
  }
  {
    const Waiting cursor;
    if (label.isEmpty())
    {
      SCOPED_UNDO_EXCLUDE();
      this->ask(order, arguments);
    }
    else
    {
      SCOPED_UNDO_SET(label);
      const QJsonObject before = this->Told;
      this->ask(order, arguments);
      // What the window does next to a new display, also once it is drawn, belongs to the step.
      drawAll();
      QCoreApplication::processEvents(QEventLoop::ExcludeUserInputEvents);
      if (!this->Problem.isEmpty() && this->Told == before)
      {
        forgetStep();
      }
    }
  }
  Q_EMIT this->changed();
}

QJsonArray CaseOrders::sorted(const QStringList& paths)
{
  const Waiting cursor;
  SCOPED_UNDO_EXCLUDE();
  return this->ask("sort", { { "paths", QJsonArray::fromStringList(paths) } }).toArray();
}

QJsonValue CaseOrders::ask(const QString& order, const QJsonObject& arguments)
{
  const QScopedValueRollback<bool> asking(this->Asking, true);
  const QJsonObject asked{ { "order", order }, { "with", arguments } };
  const auto answer = callPython(
    "brainshift.dock", "answer", QJsonDocument(asked).toJson(QJsonDocument::Compact).toStdString());
  if (!answer)
  {
    this->Trouble = tr("Python's module brainshift cannot be used here. The Output Messages have "
                       "the reason.");
    return {};
  }
  const QJsonObject told = QJsonDocument::fromJson(QByteArray::fromStdString(*answer)).object();
  (order == "tell" ? this->Trouble : this->Problem) = told["problem"].toString();
  if (told["told"].isObject())
  {
    this->Told = told["told"].toObject();
  }
  return told["told"];
}

pqPipelineSource* CaseOrders::bent() const
{
  pqPipelineSource* found = this->source("bent");
  return isDeformation(found) ? found : nullptr;
}

pqPipelineSource* CaseOrders::source(const char* key) const
{
  const auto number = static_cast<vtkTypeUInt32>(this->Told[QLatin1String(key)].toInt());
  return number == 0 ? nullptr : serverManagerModel()->findItem<pqPipelineSource*>(number);
}

void CaseOrders::refreshSoon()
{
  if (this->Watched && !this->Asking)
  {
    this->Soon.start();
  }
}

bool CaseOrders::isBusy() const
{
  const QList<pqServer*> servers = serverManagerModel()->findItems<pqServer*>();
  // A timer ends in the middle of a picture, too: asking then would update a pipeline that updates.
  const bool isUpdating = std::any_of(
    servers.begin(), servers.end(), [](pqServer* server) { return server->isProgressPending(); });
  if (servers.isEmpty() || isUpdating) // empty: between two sessions
  {
    return true;
  }
  pqPipelineSource* deformation = this->bent();
  const bool edits = deformation &&
    (StrokeEditor::of(deformation)->isEditing() || RefineEditor::of(deformation)->isActive());
  return edits || isReplayed() || pqApplicationCore::instance()->isLoadingState();
}

void CaseOrders::refresh()
{
  if (!this->Watched)
  {
    return;
  }
  if (this->isBusy())
  {
    this->Soon.start();
    return;
  }
  {
    SCOPED_UNDO_EXCLUDE();
    this->ask("tell", {});
  }
  Q_EMIT this->changed();
}
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Views/Flicker.h"

#include "Interaction/Commands/Application.h"
#include "Interaction/Views/ActiveDeformation.h"

#include <pqActiveObjects.h>
#include <pqPipelineSource.h>
#include <pqUndoStack.h>
#include <pqView.h>

#include <vtkCompareVolumes.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMSession.h>
#include <vtkSMViewProxy.h>

#include <QApplication>

#include <algorithm>
#include <cstring>
#include <iterator>
#include <utility>

namespace brainshift
{
namespace
{
QPointer<Flicker> nowOn; // the one that flickers

constexpr int EachMs = 700; // long enough to see a picture, short enough to see motion

pqServerManagerModel* model()
{
  return serverManagerModel();
}

QList<pqPipelineSource*> appliedComparisons()
{
  QList<pqPipelineSource*> found;
  for (pqPipelineSource* source : model()->findItems<pqPipelineSource*>())
  {
    if (std::strcmp(source->getProxy()->GetXMLName(), "CompareVolumes") == 0 &&
      source->modifiedState() != pqProxy::UNINITIALIZED)
    {
      found.append(source);
    }
  }
  return found;
}

// Those that the active view shows, or else all.
QList<pqPipelineSource*> comparisonsInSight()
{
  const QList<pqPipelineSource*> all = appliedComparisons();
  pqView* view = pqActiveObjects::instance().activeView();
  QList<pqPipelineSource*> inView;
  std::copy_if(all.begin(), all.end(), std::back_inserter(inView),
    [view](pqPipelineSource* filter) { return viewsShowing(filter).contains(view); });
  return inView.isEmpty() ? all : inView;
}

int showOf(pqPipelineSource* filter)
{
  return vtkSMPropertyHelper(filter->getProxy(), "Show").GetAsInt();
}

void setShow(pqPipelineSource* filter, int show)
{
  SCOPED_UNDO_EXCLUDE();
  vtkSMPropertyHelper(filter->getProxy(), "Show").Set(show);
  filter->getProxy()->UpdateVTKObjects();
}

// At once, so that each volume is seen equally long however slow the pictures are.
void draw(const QSet<pqView*>& views)
{
  for (pqView* view : views)
  {
    vtkSMViewProxy* proxy = view->getViewProxy();
    if (proxy && !proxy->GetSession()->GetPendingProgress())
    {
      view->forceRender();
    }
  }
}
}

Flicker::Flicker(QObject* parent)
  : QObject(parent)
{
  this->Next.setSingleShot(true);
  this->Next.setInterval(EachMs);
  QObject::connect(&this->Next, &QTimer::timeout, this, &Flicker::showTheOther);
  QObject::connect(model(), &pqServerManagerModel::preSourceRemoved, this, &Flicker::noticeRemoval);
  // A file keeps what was chosen, not what the flicker shows for a moment.
  QObject::connect(pqApplicationCore::instance(), &pqApplicationCore::aboutToWriteState, this,
    [this] { this->setOn(false); });
}

bool Flicker::isPossible()
{
  return !appliedComparisons().isEmpty();
}

void Flicker::stop()
{
  if (nowOn)
  {
    nowOn->setOn(false);
  }
}

void Flicker::setOn(bool on)
{
  if (on != this->Filters.isEmpty())
  {
    return; // it is so already
  }
  nowOn = on ? this : nullptr;
  if (on)
  {
    for (pqPipelineSource* filter : comparisonsInSight())
    {
      this->Filters.append({ filter, showOf(filter) });
      QObject::connect(filter, &pqPipelineSource::modifiedStateChanged, this, &Flicker::noticeEdit);
    }
    this->ShowNow = vtkCompareVolumes::Deformed;
    this->showTheOther();
  }
  else
  {
    this->Next.stop();
    const QList<Flickering> filters = std::exchange(this->Filters, {});
    QSet<pqView*> views;
    for (const Flickering& flickering : filters)
    {
      if (!flickering.filter)
      {
        continue;
      }
      QObject::disconnect(flickering.filter, nullptr, this, nullptr);
      if (showOf(flickering.filter) == this->ShowNow) // else somebody chose
      {
        setShow(flickering.filter, flickering.before);
        views += viewsShowing(flickering.filter);
      }
    }
    draw(views);
  }
  Q_EMIT this->switched(!this->Filters.isEmpty());
}

void Flicker::showTheOther()
{
  if (QApplication::mouseButtons() == Qt::NoButton) // else something is under the hand
  {
    this->ShowNow = this->ShowNow == vtkCompareVolumes::Reference ? vtkCompareVolumes::Deformed
                                                                  : vtkCompareVolumes::Reference;
    QSet<pqView*> views;
    for (const Flickering& flickering : this->Filters)
    {
      setShow(flickering.filter, this->ShowNow);
      views += viewsShowing(flickering.filter);
    }
    draw(views);
  }
  if (!this->Filters.isEmpty())
  {
    this->Next.start();
  }
}

// Before what is edited is applied: undo comes back to the state in which it was.
void Flicker::noticeEdit(pqServerManagerModelItem* filter)
{
  auto source = qobject_cast<pqPipelineSource*>(filter);
  if (source && source->modifiedState() == pqProxy::MODIFIED)
  {
    this->setOn(false);
  }
}

void Flicker::noticeRemoval(pqPipelineSource* filter)
{
  const auto gone = std::remove_if(this->Filters.begin(), this->Filters.end(),
    [filter](const Flickering& flickering) { return flickering.filter == filter; });
  if (gone != this->Filters.end())
  {
    this->Filters.erase(gone, this->Filters.end());
    if (this->Filters.isEmpty())
    {
      this->Next.stop();
      Q_EMIT this->switched(false);
    }
  }
}
}

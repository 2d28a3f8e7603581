// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Tools/LookChoice.h"

#include "Filters/Looks/Look.h"
#include "Interaction/Displays/LabelMaps.h"
#include "Interaction/Displays/VolumeLook.h"
#include "Interaction/Views/ActiveDeformation.h"

#include <pqActiveObjects.h>
#include <pqDataRepresentation.h>
#include <pqPipelineSource.h>
#include <pqUndoStack.h>
#include <pqView.h>

#include <QAction>
#include <QObject>
#include <QPointer>

#include <algorithm>

namespace brainshift
{
namespace
{
// The look of a label map that is open.
QString nameOf(pqPipelineSource* labels, int count)
{
  const auto row = std::find_if(
    lookTable().begin(), lookTable().end(), [](const LookRow& look) { return look.ofSegment; });
  const QString name = row->name;
  return count == 1 ? name : QString("%1: %2").arg(name, labels->getSMName());
}

QString withoutLabels(const QString& name)
{
  return name.section(':', 0, 0);
}

pqPipelineSource* labelsOf(pqDataRepresentation* display, const QString& name)
{
  const QList<pqPipelineSource*> maps = labelMapsFor(display);
  for (pqPipelineSource* labels : maps)
  {
    if (nameOf(labels, static_cast<int>(maps.size())) == name)
    {
      return labels;
    }
  }
  return nullptr;
}
}

QIcon iconOfLook(const QString& name)
{
  return QIcon(":/BrainShift/look-" + withoutLabels(name).toLower() + ".png");
}

QString tipOfLook(const QString& name)
{
  const auto row = std::find_if(lookTable().begin(), lookTable().end(),
    [name = withoutLabels(name)](const LookRow& look) { return name == look.name; });
  return row == lookTable().end() ? QString() : QObject::tr(row->tip);
}

QStringList looksOf(pqDataRepresentation* display)
{
  QStringList names = makeVolumeLook(display).names;
  const QList<pqPipelineSource*> maps = labelMapsFor(display);
  int place = names.isEmpty() ? 0 : 1; // the first one is that at first sight
  for (pqPipelineSource* labels : maps)
  {
    const QString name = nameOf(labels, static_cast<int>(maps.size()));
    if (!names.contains(name))
    {
      names.insert(place++, name);
    }
  }
  return names;
}

void chooseLook(pqDataRepresentation* display, const QString& name)
{
  VolumeLook look = makeVolumeLook(display, name);
  BEGIN_UNDO_SET(QObject::tr("Look: %1").arg(name));
  if (!look.names.contains(name)) // a CT has a Brain of its own
  {
    segmentBy(display, labelsOf(display, name));
    look = makeVolumeLook(display, withoutLabels(name));
  }
  applyLook(display, look);
  END_UNDO_SET();
  rememberLook(look.kind, look.name);
  display->renderViewEventually();
}

namespace
{
bool isShownVolume(pqDataRepresentation* display)
{
  return display && display->isVisible() && showsVolume(display);
}

// The Deformed Volume of the active source, else the first one of the active view.
pqDataRepresentation* shownVolume()
{
  pqDataRepresentation* active = pqActiveObjects::instance().activeRepresentation();
  if (isShownVolume(active))
  {
    return active;
  }
  pqView* view = pqActiveObjects::instance().activeView();
  for (pqRepresentation* display : view ? view->getRepresentations() : QList<pqRepresentation*>())
  {
    auto data = qobject_cast<pqDataRepresentation*>(display);
    if (isShownVolume(data))
    {
      return data;
    }
  }
  return nullptr;
}
}

LookMenu::LookMenu(QWidget* parent)
  : QMenu(tr("Look"), parent)
{
  this->setToolTipsVisible(true);
  this->connect(this, &QMenu::aboutToShow, this, &LookMenu::offer);
}

void LookMenu::offer()
{
  this->clear();
  const QPointer<pqDataRepresentation> display = shownVolume();
  const QStringList names = display ? looksOf(display) : QStringList();
  for (const QString& name : names)
  {
    QAction* action = this->addAction(iconOfLook(name), name);
    action->setObjectName("actionBrainShiftLook" + name);
    action->setToolTip(tipOfLook(name));
    this->connect(action, &QAction::triggered, this, [display, name] {
      if (display)
      {
        chooseLook(display, name);
      }
    });
  }
  if (names.isEmpty())
  {
    this
      ->addAction(
        display ? tr("This volume has no presets") : tr("The view shows no Deformed Volume"))
      ->setEnabled(false);
  }
}
}

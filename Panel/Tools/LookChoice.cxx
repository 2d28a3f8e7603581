// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Tools/LookChoice.h"

#include "Filters/Looks/Look.h"
#include "Interaction/Displays/LabelMaps.h"
#include "Interaction/Displays/VolumeLook.h"

#include <pqDataRepresentation.h>
#include <pqPipelineSource.h>
#include <pqUndoStack.h>

#include <QList>
#include <QObject>

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
}

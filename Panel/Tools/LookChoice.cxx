// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Tools/LookChoice.h"

#include "Interaction/Displays/LabelMaps.h"
#include "Interaction/Displays/VolumeLook.h"

#include <pqDataRepresentation.h>
#include <pqPipelineSource.h>
#include <pqUndoStack.h>

#include <QList>
#include <QMap>
#include <QObject>

namespace brainshift
{
namespace
{
constexpr const char* Brain = "Brain";

QString nameOf(pqPipelineSource* labels, int count)
{
  return count == 1 ? QString(Brain) : QString("%1: %2").arg(Brain, labels->getSMName());
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
  static const QMap<QString, QString> tips{
    { "Skin", QObject::tr("Show the outer surface without the background.") },
    { "See-through", QObject::tr("Show the inside through a faint surface.") },
    { "Brain", QObject::tr("Show the brain. Outside CT, this needs a segmentation.") },
    { "Bone", QObject::tr("Show bone: 150 HU and above.") },
    { "Vessels", QObject::tr("Show vessels with contrast agent: 120 HU and above.") },
    { "Ultrasound", QObject::tr("Show bright echoes. Dark ones are transparent.") },
  };
  return tips.value(withoutLabels(name));
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

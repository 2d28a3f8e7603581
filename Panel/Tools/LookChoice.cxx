// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Tools/LookChoice.h"

#include "Interaction/Views/VolumeLook.h"

#include <pqDataRepresentation.h>
#include <pqUndoStack.h>

#include <QMap>
#include <QObject>

namespace brainshift
{
QIcon iconOfLook(const QString& name)
{
  return QIcon(":/BrainShift/look-" + name.toLower() + ".png");
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
  return tips.value(name);
}

void chooseLook(pqDataRepresentation* display, const QString& name)
{
  const VolumeLook look = makeVolumeLook(display, name);
  BEGIN_UNDO_SET(QObject::tr("Look: %1").arg(name));
  applyLook(display, look);
  END_UNDO_SET();
  rememberLook(look.kind, name);
  display->renderViewEventually();
}
}

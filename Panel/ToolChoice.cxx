// SPDX-License-Identifier: BSD-3-Clause
#include "ToolChoice.h"

#include <QCoreApplication>

namespace
{
QString tr(const char* text)
{
  return QCoreApplication::translate("BrainShift", text);
}

ToolChoice choice(
  ToolSettings::Tool tool, const QString& id, const char* name, const char* keys, const char* what)
{
  const QKeySequence shortcut(keys);
  return { tool, id, tr(name), ":/BrainShift/" + id.toLower() + ".svg", shortcut, tr(what),
    tr("%1 (%2). Again: put the tool down.")
      .arg(tr(what), shortcut.toString(QKeySequence::NativeText)) };
}
}

const QList<ToolChoice>& toolChoices()
{
  using Tool = ToolSettings::Tool;
  static const QList<ToolChoice> choices{
    choice(Tool::Move, "Move", QT_TRANSLATE_NOOP("BrainShift", "Move"), "Alt+1",
      QT_TRANSLATE_NOOP("BrainShift", "Move single control points")),
    choice(Tool::Soft, "Soft", QT_TRANSLATE_NOOP("BrainShift", "Soft"), "Alt+2",
      QT_TRANSLATE_NOOP("BrainShift", "Drag all tissue within a radius")),
    choice(Tool::Stamp, "Stamp", QT_TRANSLATE_NOOP("BrainShift", "Stamp"), "Alt+3",
      QT_TRANSLATE_NOOP("BrainShift", "Pull or push an ellipsoid of tissue with the wheel")),
  };
  return choices;
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Tools/ToolChoice.h"

#include "Interaction/Commands/Commands.h"

#include <QCoreApplication>

namespace brainshift
{
namespace
{
QString tr(const char* text)
{
  return QCoreApplication::translate("BrainShift", text);
}

ToolChoice choice(ToolKind tool, const QString& id)
{
  const CommandRow& row = rowOf(Command::TakeTool, tool);
  const QKeySequence shortcut = shortcutOf(Command::TakeTool, tool);
  return { tool, id, nameOf(tool), ":/BrainShift/" + id.toLower() + ".svg", shortcut,
    tr("%1 Shortcut: %2. Click again to put the tool down.")
      .arg(tr(row.what), shortcut.toString(QKeySequence::NativeText)) };
}
}

const QList<ToolChoice>& toolChoices()
{
  static const QList<ToolChoice> choices{
    choice(ToolKind::Move, "Move"),
    choice(ToolKind::Soft, "Soft"),
    choice(ToolKind::Stamp, "Stamp"),
    choice(ToolKind::Pull, "Pull"),
  };
  return choices;
}
}

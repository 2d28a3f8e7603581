// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Tools/MouseHint.h"

#include "Interaction/Commands/Commands.h"
#include "Interaction/Commands/Tools.h"
#include "Interaction/Commands/Application.h"

#include <QStringList>

#include <algorithm>

namespace brainshift
{
namespace
{
using AxisHold = ToolSettings::AxisHold;
using Ground = ToolSettings::Ground;

QString millimetres(double value)
{
  return tr("%1 mm").arg(value, 0, 'g', 3);
}

bool isOfTool(const CommandRow& row, Tool tool)
{
  return std::find(row.tools.begin(), row.tools.end(), tool) != row.tools.end();
}

// The tool in hand has precedence over the slices for its own gestures.
bool isTakenByTool(const CommandRow& row, Tool tool)
{
  return row.mouse != Mouse::None &&
    commandOfMouse(Scope::Tool, tool, row.mouse, row.modifiers & Qt::ShiftModifier,
      row.modifiers & Qt::ControlModifier) != Command::None;
}

QString hintOf(const CommandRow& row, const ToolSettings& settings)
{
  QString hint = tr(row.hint);
  if (row.number)
  {
    hint = hint.arg(millimetres((settings.*row.number)()));
  }
  return tr("%1: %2.").arg(keysText(row), hint);
}

// One hint for each command. With a tool in hand there is room for one only: how to step through
// the slices.
QStringList sliceHints(const ToolSettings& settings)
{
  const Tool tool = settings.tool();
  QStringList hints;
  Command last = Command::None;
  for (const CommandRow& row : commandTable())
  {
    const bool fits = tool == Tool::None || row.command == Command::StepSlices;
    if (row.scope == Scope::Slices && *row.hint && fits && row.command != last &&
      !isTakenByTool(row, tool))
    {
      hints.append(hintOf(row, settings));
      last = row.command;
    }
  }
  return hints;
}

QString heldAxis(AxisHold axis)
{
  switch (axis)
  {
    case AxisHold::X:
      return tr("Held to X.");
    case AxisHold::Y:
      return tr("Held to Y.");
    case AxisHold::Z:
      return tr("Held to Z.");
    case AxisHold::None:
      break;
  }
  return {};
}
}

QString mouseHint(const ToolSettings& settings, ToolSettings::Ground ground)
{
  const Tool tool = settings.tool();
  QStringList hints;
  if (!settings.request().isEmpty())
  {
    return settings.request();
  }
  if (tool != Tool::None && !settings.shownInstead().isEmpty())
  {
    return tr(
      "%1. This view shows %2, not the volume that is selected. Click in the view to work on "
      "%2.")
      .arg(nameOf(tool), settings.shownInstead());
  }
  if (tool != Tool::None)
  {
    hints.append(
      (ground == Ground::Volume ? tr("%1.") : tr("%1 within the slice.")).arg(nameOf(tool)));
    for (const CommandRow& row : commandTable())
    {
      if (row.scope == Scope::Tool && *row.hint && isOfTool(row, tool))
      {
        hints.append(hintOf(row, settings));
      }
    }
  }
  else if (ground != Ground::FlatSlices)
  {
    return tr("No tool is in hand. The mouse moves the camera.");
  }
  if (ground == Ground::FlatSlices)
  {
    hints += sliceHints(settings);
  }
  hints.append(toolRow(tool).holdsAxes ? heldAxis(settings.axisHold()) : QString());
  hints.removeAll(QString());
  return hints.join(' ');
}
}

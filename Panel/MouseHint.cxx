// SPDX-License-Identifier: BSD-3-Clause
#include "MouseHint.h"

#include <QCoreApplication>

using Tool = ToolSettings::Tool;
using AxisHold = ToolSettings::AxisHold;
using Ground = ToolSettings::Ground;

namespace
{
QString tr(const char* text)
{
  return QCoreApplication::translate("BrainShift", text);
}

QString millimetres(double value)
{
  return tr("%1 mm").arg(value, 0, 'g', 3);
}

QString heldAxis(AxisHold axis)
{
  switch (axis)
  {
    case AxisHold::X:
      return tr(" Held to X.");
    case AxisHold::Y:
      return tr(" Held to Y.");
    case AxisHold::Z:
      return tr(" Held to Z.");
    case AxisHold::None:
      break;
  }
  return {};
}

QString inSlice(Ground ground)
{
  return ground == Ground::Volume ? QString() : tr(" within the slice");
}

// Who has the wheel in a 2D view of slices.
QString wheelHint(Tool tool, Ground ground)
{
  if (ground != Ground::FlatSlices)
  {
    return {};
  }
  return tool == Tool::Stamp ? tr(" Page Up/Down and the wheel beside the slice: next slice.")
                             : tr(" Wheel: next slice.");
}

QString restingHint(Ground ground)
{
  return ground == Ground::FlatSlices
    ? tr("Wheel: next slice; Shift+drag: other slices to the cursor; Ctrl+wheel: zoom.")
    : tr("No tool in hand: the mouse moves the camera.");
}
}

QString mouseHint(const ToolSettings& settings, Ground ground)
{
  const QString wheel = wheelHint(settings.tool(), ground);
  switch (settings.tool())
  {
    case Tool::Move:
      return tr("Move: drag a control point%1. Shift+click selects several; X, Y or Z while "
                "dragging "
                "holds an axis.")
               .arg(inSlice(ground)) +
        wheel + heldAxis(settings.axisHold());
    case Tool::Soft:
      return tr("Soft: drag tissue%1; what lies within %2 follows. Shift+wheel changes the radius; "
                "X, Y or Z while dragging holds an axis.")
               .arg(inSlice(ground), millimetres(settings.radius())) +
        wheel + heldAxis(settings.axisHold());
    case Tool::Stamp:
      return tr(
               "Stamp: over tissue the wheel pulls and pushes%1 by %2 a click, and so does a drag. "
               "Shift+wheel changes the major radius; I sets the point of interest.")
               .arg(inSlice(ground), millimetres(settings.millimetresPerClick())) +
        wheel;
    case Tool::None:
      break;
  }
  return restingHint(ground);
}

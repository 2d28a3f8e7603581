// SPDX-License-Identifier: BSD-3-Clause
#include "MouseHint.h"

#include "ToolSettings.h"

#include <QCoreApplication>

using Tool = ToolSettings::Tool;
using AxisHold = ToolSettings::AxisHold;

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
}

QString mouseHint(const ToolSettings& settings)
{
  switch (settings.tool())
  {
    case Tool::Move:
      return tr("Move: drag a control point. Shift+click selects several; X, Y or Z while dragging "
                "holds "
                "an axis. Elsewhere the mouse moves the camera.") +
        heldAxis(settings.axisHold());
    case Tool::Soft:
      return tr("Soft: drag tissue; what lies within %1 follows. Shift+wheel changes the radius; "
                "X, Y or "
                "Z while dragging holds an axis.")
               .arg(millimetres(settings.radius())) +
        heldAxis(settings.axisHold());
    case Tool::Stamp:
      return tr("Stamp: over tissue the wheel pulls and pushes by %1 a click, and so does a drag. "
                "Shift+wheel changes the major radius; I sets the point of interest.")
        .arg(millimetres(settings.millimetresPerClick()));
    case Tool::None:
      break;
  }
  return tr("No tool in hand: the mouse moves the camera.");
}

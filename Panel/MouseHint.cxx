// SPDX-License-Identifier: BSD-3-Clause
#include "MouseHint.h"

#include "ToolSettings.h"

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

QString inSlice(const ToolSettings& settings)
{
  return settings.ground() == Ground::Volume ? QString() : tr(" within the slice");
}

// Who has the wheel in a 2D view of slices.
QString wheelHint(const ToolSettings& settings)
{
  if (settings.ground() != Ground::FlatSlices)
  {
    return {};
  }
  return settings.tool() == Tool::Stamp
    ? tr(" Page Up, Page Down, and the wheel beside the slice, go through the slices.")
    : tr(" The wheel goes through the slices.");
}

QString restingHint(const ToolSettings& settings)
{
  return settings.ground() == Ground::FlatSlices
    ? tr("The wheel goes through the slices, with Ctrl it zooms; dragging with Shift brings the "
         "other slices to the cursor.")
    : tr("No tool in hand: the mouse moves the camera.");
}
}

QString mouseHint(const ToolSettings& settings)
{
  switch (settings.tool())
  {
    case Tool::Move:
      return tr("Move: drag a control point%1. Shift+click selects several; X, Y or Z while "
                "dragging "
                "holds an axis. Elsewhere the mouse moves the camera.")
               .arg(inSlice(settings)) +
        wheelHint(settings) + heldAxis(settings.axisHold());
    case Tool::Soft:
      return tr("Soft: drag tissue%1; what lies within %2 follows. Shift+wheel changes the radius; "
                "X, Y or Z while dragging holds an axis.")
               .arg(inSlice(settings), millimetres(settings.radius())) +
        wheelHint(settings) + heldAxis(settings.axisHold());
    case Tool::Stamp:
      return tr(
               "Stamp: over tissue the wheel pulls and pushes%1 by %2 a click, and so does a drag. "
               "Shift+wheel changes the major radius; I sets the point of interest.")
               .arg(inSlice(settings), millimetres(settings.millimetresPerClick())) +
        wheelHint(settings);
    case Tool::None:
      break;
  }
  return restingHint(settings);
}

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A row of the table of keys and gestures.
#ifndef BrainShift_CommandRow_h
#define BrainShift_CommandRow_h

#include "Interaction/Commands/ToolSettings.h"

#include <QKeyCombination>

namespace brainshift
{
/// What a key or a gesture of the mouse does.
enum class Command
{
  None,
  TakeTool,
  Flicker,
  Undo, ///< ParaView does it.
  Redo, ///< ParaView does it.
  RecordTrace,
  ShowCase,
  DragTissue, ///< Or a control point.
  Select,     ///< Selects a control point, or pins tissue.
  ChangeRadius,
  StepByWheel,
  StepByKey,   ///< Keys: forward, backward.
  MoveCursor,  ///< Keys: left, right, up, down.
  TakeHold,    ///< Key: drags without a mouse.
  SelectByKey, ///< The key of TakeHold with Shift: Select without a mouse.
  SetPointOfInterest,
  HoldAxis, ///< Keys: X, Y, Z.
  Cancel,
  SwitchVolume,
  ShowAsLoaded,
  StepSlices, ///< Keys: forward, backward.
  BringSlices,
  MoveWipe,
  ChangeGreyValues,
  Zoom, ///< ParaView does it.
  EnlargeView,
  ToggleStrokes,
  ChooseNumber, ///< Keys: left, right.
  EditNumber,
  DeleteStrokes,
};

/// Where a command works. Each scope is a section of the help.
enum class Scope
{
  Window,
  Tool,   ///< A view, with a tool in hand.
  View,   ///< A view, with or without a tool.
  Slices, ///< A 2D view of slices.
  List,   ///< The list of strokes.
};

enum class Mouse
{
  None,
  Drag,
  RightDrag, ///< With the right button.
  Click,
  DoubleClick,
  Wheel,
};

/// One row of the table: a gesture of the mouse, or keys, and what they do.
struct CommandRow
{
  Command command = Command::None;
  Scope scope = Scope::Window;
  std::vector<Tool> tools; ///< The command needs one of them in hand. Empty: it needs none.
  Mouse mouse = Mouse::None;
  Qt::KeyboardModifiers modifiers;   ///< Of the gesture.
  std::vector<QKeyCombination> keys; ///< Empty where a gesture is given.
  const char* what = "";             ///< Whole sentences, for help and documentation.
  const char* hint = "";             ///< A few words for the status line. Empty: not shown there.
  double (ToolSettings::*number)() const = nullptr; ///< The %1 of the hint, mm.
};

/// A gesture of the mouse with a tool in hand. The table of tools adds which one.
inline CommandRow byMouse(
  Command command, Mouse mouse, Qt::KeyboardModifiers modifiers, const char* what, const char* hint)
{
  return { command, Scope::Tool, {}, mouse, modifiers, {}, what, hint };
}

/// Keys with a tool in hand.
inline CommandRow byKey(Command command, const std::vector<QKeyCombination>& keys, const char* what,
  const char* hint = "")
{
  return { command, Scope::Tool, {}, Mouse::None, {}, keys, what, hint };
}
}

#endif

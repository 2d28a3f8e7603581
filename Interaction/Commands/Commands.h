// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The one table of keys and gestures. Tools, slices, list and toolbar ask it which command an
/// event means; the help window, the status line and Documentation/keys.md are written from it.
#ifndef BrainShift_Commands_h
#define BrainShift_Commands_h

#include "Interaction/Commands/ToolSettings.h"

#include <QKeyCombination>
#include <QKeySequence>
#include <QString>

#include <initializer_list>
#include <vector>

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
  MoveControlPoints,
  SelectControlPoint,
  MoveTissue,
  ChangeRadius,
  StampByClick,
  StampByDrag,
  StampByKey, ///< Keys: forward, backward.
  MoveCursor, ///< Keys: left, right, up, down.
  TakeHold,   ///< Key: drags without a mouse. With Shift: SelectByKey, PinByKey.
  SelectByKey,
  ChangeMajorRadius,
  PullTissue,
  PinTissue,
  PinByKey,
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
  std::vector<ToolKind> tools; ///< The command needs one of them in hand. Empty: it needs none.
  Mouse mouse = Mouse::None;
  Qt::KeyboardModifiers modifiers;   ///< Of the gesture.
  std::vector<QKeyCombination> keys; ///< Empty where a gesture is given.
  const char* what = "";             ///< Whole sentences, for help and documentation.
  const char* hint = "";             ///< A few words for the status line. Empty: not shown there.
};

const std::vector<CommandRow>& commandTable();

/// The first row of a command, with this tool if one is named.
const CommandRow& rowOf(Command command, ToolKind tool = ToolKind::None);

/// A command and the place of its key in the row: HoldAxis with place 1 holds the Y axis.
struct KeyCommand
{
  Command command = Command::None;
  int place = 0;
};

/// What a key means in one of these scopes, whatever its modifiers are. Command::None: nothing.
KeyCommand commandOfKey(std::initializer_list<Scope> scopes, int key);

/// What a gesture means. Control must be held exactly where the row asks for it. Where no row asks
/// for Shift, Shift makes no difference.
Command commandOfMouse(Scope scope, ToolKind tool, Mouse mouse, bool shift, bool control);

/// The shortcut of a command that the window answers.
QKeySequence shortcutOf(Command command, ToolKind tool = ToolKind::None);

/// The gesture or the keys as the user reads them: "Shift+Wheel", "Page Up, Page Down".
QString keysText(const CommandRow& row);

/// Heading of a scope, and a remark on all of its commands (may be empty).
QString headingOf(Scope scope);
QString remarkOn(Scope scope);

/// What the user calls a tool: "Stamp".
QString nameOf(ToolKind tool);
}

#endif

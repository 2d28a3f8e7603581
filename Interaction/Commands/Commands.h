// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The one table of keys and gestures. Tools, slices, list and toolbar look up in it which command
/// an event means; the help window, the status line and Documentation/keys.md are written from it.
#ifndef BrainShift_Commands_h
#define BrainShift_Commands_h

#include "Interaction/Commands/CommandRow.h"

#include <QKeySequence>

#include <initializer_list>

namespace brainshift
{
const std::vector<CommandRow>& commandTable();

/// The first row of a command, with this tool if one is named.
const CommandRow& rowOf(Command command, Tool tool = Tool::None);

/// A command and the index of its key in the row: HoldAxis with index 1 holds the Y axis.
struct KeyCommand
{
  Command command = Command::None;
  int index = 0; ///< Of the key in its row.
};

/// What a key means in one of these scopes, whatever its modifiers are. Command::None: nothing.
KeyCommand commandOfKey(std::initializer_list<Scope> scopes, int key);

/// What a gesture means. Control must be held exactly where the row requires it. Where no row
/// requires Shift, Shift makes no difference.
Command commandOfMouse(Scope scope, Tool tool, Mouse mouse, bool shift, bool control);

/// Whether a text field has the focus. Keys are then letters.
bool isTyping();

/// Whether a command works with a tool in hand.
bool works(Command command, Tool tool);

/// The shortcut of a command that the window handles.
QKeySequence shortcutOf(Command command, Tool tool = Tool::None);

/// The gesture or the keys as the user reads them: "Shift+Wheel", "Page Up, Page Down".
QString keysText(const CommandRow& row);

/// Heading of a scope, and a remark on all of its commands (may be empty).
QString headingOf(Scope scope);
QString remarkOn(Scope scope);
}

#endif

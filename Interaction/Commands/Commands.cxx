// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Commands/Commands.h"

#include "Interaction/Commands/Application.h"
#include "Interaction/Commands/Tools.h"

#include <QApplication>
#include <QStringList>
#include <QWidget>

#include <algorithm>
#include <utility>

namespace brainshift
{
namespace
{
using Tools = std::vector<Tool>;
using Keys = std::vector<QKeyCombination>;

struct Gesture
{
  Mouse mouse;
  Qt::KeyboardModifiers modifiers;
};

CommandRow byMouse(
  Command command, Scope scope, const Gesture& gesture, const char* what, const char* hint)
{
  return { command, scope, {}, gesture.mouse, gesture.modifiers, {}, what, hint };
}

CommandRow byKey(
  Command command, Scope scope, const Keys& keys, const char* what, const char* hint = "")
{
  return { command, scope, {}, Mouse::None, {}, keys, what, hint };
}

// The row for these tools alone.
CommandRow onlyFor(const Tools& tools, CommandRow row)
{
  row.tools = tools;
  return row;
}

std::vector<CommandRow> windowRows()
{
  return {
    byKey(Command::Flicker, Scope::Window, { Qt::Key_K },
      QT_TRANSLATE_NOOP("BrainShift",
        "Show the deformed volume and the reference of Compare Volumes in turn. Press the key "
        "again to stop.")),
    byKey(Command::RecordTrace, Scope::Window, { Qt::Key_T },
      QT_TRANSLATE_NOOP("BrainShift",
        "While a pointer is connected: record a trace as long as the key is held down.")),
    byKey(Command::ShowCase, Scope::Window, { Qt::ALT | Qt::Key_0 },
      QT_TRANSLATE_NOOP("BrainShift", "Go to the dock Case. Press the key there to hide it.")),
    byKey(Command::Undo, Scope::Window, { Qt::CTRL | Qt::Key_Z },
      QT_TRANSLATE_NOOP("BrainShift", "Undo the last edit. Each stroke is one edit.")),
    byKey(Command::Redo, Scope::Window, { Qt::CTRL | Qt::Key_Y },
      QT_TRANSLATE_NOOP("BrainShift", "Redo the last undone edit.")),
  };
}

// What each tool does, as its own file says. Keys are found in order: those of SelectByKey are also
// those of TakeHold, and come after it.
std::vector<CommandRow> toolRows(bool selectsByKey)
{
  std::vector<CommandRow> rows;
  for (const ToolRow& tool : toolTable())
  {
    for (CommandRow row : tool.gestures)
    {
      row.tools = { tool.tool };
      if ((row.command == Command::SelectByKey) == selectsByKey)
      {
        rows.push_back(row);
      }
    }
  }
  return rows;
}

std::vector<CommandRow> takeToolRows()
{
  std::vector<CommandRow> rows;
  for (const ToolRow& tool : toolTable())
  {
    rows.push_back(
      onlyFor({ tool.tool }, byKey(Command::TakeTool, Scope::Window, { tool.key }, tool.what)));
  }
  return rows;
}

Tools toolsWithAxes()
{
  Tools tools;
  for (const ToolRow& tool : toolTable())
  {
    if (tool.holdsAxes)
    {
      tools.push_back(tool.tool);
    }
  }
  return tools;
}

std::vector<CommandRow> handRows()
{
  return {
    onlyFor(toolsWithAxes(),
      byKey(Command::HoldAxis, Scope::Tool, { Qt::Key_X, Qt::Key_Y, Qt::Key_Z },
        QT_TRANSLATE_NOOP("BrainShift",
          "During a drag: hold the drag to that world axis. Press the key again to release it."),
        QT_TRANSLATE_NOOP("BrainShift", "hold the drag to an axis"))),
    byKey(Command::MoveCursor, Scope::Tool,
      { Qt::Key_Left, Qt::Key_Right, Qt::Key_Up, Qt::Key_Down },
      QT_TRANSLATE_NOOP("BrainShift",
        "Move the cursor over the view. If the cursor is outside the view, it first moves to the "
        "middle of the view. The view must have the keyboard focus. Taking a tool gives the focus "
        "to the active view.")),
    byKey(Command::TakeHold, Scope::Tool, { Qt::Key_Space },
      QT_TRANSLATE_NOOP("BrainShift",
        "Grab the tissue or control point under the cursor, as a mouse button does. Drag it with "
        "Left, Right, Up and Down. Press the key again to let go.")),
    byKey(Command::Cancel, Scope::Tool, { Qt::Key_Escape },
      QT_TRANSLATE_NOOP("BrainShift", "Cancel the current stroke.")),
    byMouse(Command::SwitchVolume, Scope::Tool, { Mouse::Click, {} },
      QT_TRANSLATE_NOOP("BrainShift",
        "Over a volume that is not selected: select that volume to work on it. The click makes no "
        "stroke."),
      ""),
  };
}

std::vector<CommandRow> viewRows()
{
  return {
    byKey(Command::ShowAsLoaded, Scope::View, { Qt::Key_O },
      QT_TRANSLATE_NOOP("BrainShift", "Show the volume as loaded while the key is held down.")),
    byMouse(Command::EnlargeView, Scope::View, { Mouse::DoubleClick, {} },
      QT_TRANSLATE_NOOP("BrainShift",
        "In Four Views, without a tool in hand: make the view as large as the layout. Double-click "
        "again to see all four."),
      ""),
    byMouse(Command::StepSlices, Scope::Slices, { Mouse::Wheel, {} },
      QT_TRANSLATE_NOOP("BrainShift",
        "Step through the slices, one voxel per click. If the tool in hand uses the wheel, this "
        "works only away from tissue."),
      QT_TRANSLATE_NOOP("BrainShift", "next slice")),
    byKey(Command::StepSlices, Scope::Slices, { Qt::Key_PageUp, Qt::Key_PageDown },
      QT_TRANSLATE_NOOP("BrainShift", "Step through the slices, one voxel each time."),
      QT_TRANSLATE_NOOP("BrainShift", "next slice")),
    byMouse(Command::BringSlices, Scope::Slices, { Mouse::Drag, Qt::ShiftModifier },
      QT_TRANSLATE_NOOP("BrainShift", "Bring the other slices to the cursor."),
      QT_TRANSLATE_NOOP("BrainShift", "bring the other slices to the cursor")),
    byMouse(Command::MoveWipe, Scope::Slices, { Mouse::Drag, {} },
      QT_TRANSLATE_NOOP("BrainShift", "On the line of a Wipe comparison: move the line."), ""),
    byMouse(Command::ChangeGreyValues, Scope::Slices, { Mouse::RightDrag, {} },
      QT_TRANSLATE_NOOP("BrainShift",
        "Change the grey values. Drag to the right for a wider window (less contrast), upwards for "
        "a higher level (darker). Each drag is one edit."),
      QT_TRANSLATE_NOOP("BrainShift", "window and level")),
    byMouse(Command::Zoom, Scope::Slices, { Mouse::Wheel, Qt::ControlModifier },
      QT_TRANSLATE_NOOP("BrainShift", "Zoom. All slices of Four Views zoom together."),
      QT_TRANSLATE_NOOP("BrainShift", "zoom")),
    byMouse(Command::Zoom, Scope::Slices, { Mouse::RightDrag, Qt::ControlModifier },
      QT_TRANSLATE_NOOP("BrainShift", "Zoom smoothly."), ""),
  };
}

std::vector<CommandRow> listRows()
{
  return {
    byKey(Command::ToggleStrokes, Scope::List, { Qt::Key_Space },
      QT_TRANSLATE_NOOP("BrainShift", "Disable or enable the selected strokes.")),
    byKey(Command::ChooseNumber, Scope::List, { Qt::Key_Left, Qt::Key_Right },
      QT_TRANSLATE_NOOP("BrainShift", "Select the previous or the next number of the stroke.")),
    byKey(Command::EditNumber, Scope::List, { Qt::Key_Return, Qt::Key_Enter },
      QT_TRANSLATE_NOOP("BrainShift", "Edit the selected number.")),
    byKey(Command::DeleteStrokes, Scope::List, { Qt::Key_Delete },
      QT_TRANSLATE_NOOP("BrainShift", "Delete the selected strokes.")),
  };
}

bool worksWith(const CommandRow& row, Tool tool)
{
  return row.tools.empty() ||
    std::find(row.tools.begin(), row.tools.end(), tool) != row.tools.end();
}

Command commandOfGesture(Scope scope, Tool tool, Mouse mouse, Qt::KeyboardModifiers modifiers)
{
  for (const CommandRow& row : commandTable())
  {
    if (row.scope == scope && row.mouse == mouse && row.modifiers == modifiers &&
      worksWith(row, tool))
    {
      return row.command;
    }
  }
  return Command::None;
}

QString keyText(QKeyCombination key)
{
  static const std::array<std::pair<const char*, const char*>, 5> longNames{ {
    { "PgUp", "Page Up" },
    { "PgDown", "Page Down" },
    { "Esc", "Escape" },
    { "Del", "Delete" },
    { "Return", "Enter" },
  } };
  const QString text = QKeySequence(key).toString(QKeySequence::PortableText);
  for (const auto& [brief, whole] : longNames)
  {
    if (text == brief)
    {
      return tr(whole);
    }
  }
  return text;
}

QString mouseText(Mouse mouse)
{
  switch (mouse)
  {
    case Mouse::Drag:
      return tr("Drag");
    case Mouse::RightDrag:
      return tr("Right-drag");
    case Mouse::Click:
      return tr("Click");
    case Mouse::DoubleClick:
      return tr("Double-click");
    case Mouse::Wheel:
      return tr("Wheel");
    case Mouse::None:
      break;
  }
  return {};
}
}

const std::vector<CommandRow>& commandTable()
{
  static const std::vector<CommandRow> table = [] {
    std::vector<CommandRow> all;
    for (const auto& rows : { takeToolRows(), windowRows(), toolRows(false), handRows(),
           toolRows(true), viewRows(), listRows() })
    {
      all.insert(all.end(), rows.begin(), rows.end());
    }
    return all;
  }();
  return table;
}

const CommandRow& rowOf(Command command, Tool tool)
{
  const std::vector<CommandRow>& table = commandTable();
  static const CommandRow nothing;
  const auto found = std::find_if(table.begin(), table.end(), [=](const CommandRow& row) {
    return row.command == command && (tool == Tool::None || worksWith(row, tool));
  });
  return found == table.end() ? nothing : *found;
}

bool isTyping()
{
  QWidget* focus = QApplication::focusWidget();
  return focus && focus->testAttribute(Qt::WA_InputMethodEnabled);
}

bool works(Command command, Tool tool)
{
  const std::vector<CommandRow>& table = commandTable();
  return std::any_of(table.begin(), table.end(),
    [=](const CommandRow& row) { return row.command == command && worksWith(row, tool); });
}

KeyCommand commandOfKey(std::initializer_list<Scope> scopes, int key)
{
  for (const CommandRow& row : commandTable())
  {
    const auto found = std::find_if(row.keys.begin(), row.keys.end(),
      [key](QKeyCombination combination) { return combination.key() == key; });
    const bool heard = std::find(scopes.begin(), scopes.end(), row.scope) != scopes.end();
    if (heard && found != row.keys.end())
    {
      return { row.command, static_cast<int>(found - row.keys.begin()) };
    }
  }
  return {};
}

Command commandOfMouse(Scope scope, Tool tool, Mouse mouse, bool shift, bool control)
{
  const Qt::KeyboardModifiers without = control ? Qt::ControlModifier : Qt::NoModifier;
  const Command exact =
    commandOfGesture(scope, tool, mouse, shift ? without | Qt::ShiftModifier : without);
  return exact == Command::None ? commandOfGesture(scope, tool, mouse, without) : exact;
}

QKeySequence shortcutOf(Command command, Tool tool)
{
  const CommandRow& row = rowOf(command, tool);
  return row.keys.empty() ? QKeySequence() : QKeySequence(row.keys.front());
}

QString keysText(const CommandRow& row)
{
  QStringList texts;
  for (const QKeyCombination key : row.keys)
  {
    texts.append(keyText(key));
  }
  texts.removeDuplicates(); // a keyboard has two keys called Enter
  if (row.mouse == Mouse::None)
  {
    return texts.join(", ");
  }
  QString text = mouseText(row.mouse);
  text.prepend(row.modifiers & Qt::ShiftModifier ? tr("Shift+") : QString());
  text.prepend(row.modifiers & Qt::ControlModifier ? tr("Ctrl+") : QString());
  return text;
}

QString headingOf(Scope scope)
{
  switch (scope)
  {
    case Scope::Window:
      return tr("In the whole window");
    case Scope::Tool:
      return tr("In the view, with a tool in hand");
    case Scope::View:
      return tr("In the view, with or without a tool");
    case Scope::Slices:
      return tr("In a 2D view of slices");
    case Scope::List:
      return tr("In the list of strokes");
  }
  return {};
}

QString remarkOn(Scope scope)
{
  switch (scope)
  {
    case Scope::Window:
      return tr("Press %1 to %2 to take a tool in hand. Press the same key again to put it down.")
        .arg(keyText(toolTable().front().key), keyText(toolTable().back().key));
    case Scope::Tool:
      return tr("Over a slice, every tool works within the slice. Away from tissue, and with the "
                "other mouse buttons, the mouse works as without a tool.");
    default:
      return {};
  }
}
}

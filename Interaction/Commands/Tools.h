// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The table of tools. Each tool writes its row in its own file, Interaction/Tools/NameTool.cxx;
/// buttons, keys, hints, sliders, the tutorial and the hand read the rows.
#ifndef BrainShift_Tools_h
#define BrainShift_Tools_h

#include "Interaction/Commands/CommandRow.h"

#include <QKeySequence>

#include <memory>
#include <optional>

namespace brainshift
{
class HandTool;
struct ToolBench;

/// A step of the tutorial. Texts are not translated yet.
struct Lesson
{
  const char* title;
  const char* text;
  const char* button; ///< Takes the tool.
};

struct ToolRow
{
  Tool tool = Tool::None;
  QKeyCombination key;   ///< Takes it in hand, in the whole window. It must be free in ParaView.
  const char* what = ""; ///< Purpose of the tool: whole sentences.
  const char* page = ""; ///< Its page, in Documentation.
  std::vector<CommandRow> gestures;                      ///< Its gestures and keys.
  bool holdsAxes = true;                                 ///< X, Y and Z hold a drag to an axis.
  std::vector<double (ToolSettings::*)() const> numbers; ///< Shown in the panel.
  std::optional<Lesson> lesson;
  std::unique_ptr<HandTool> (*make)(const ToolBench&) = nullptr;

  /// Last part of the names of its buttons: "Stamp".
  QString id() const { return traitsOf(this->tool).name; }
  QString icon() const; ///< File among the resources.
  QString tip() const;  ///< Purpose, shortcut, and how to put the tool down.
};

/// All tools, in the order of their keys and buttons.
const std::vector<ToolRow>& toolTable();

/// The row of a tool. That of Tool::None is empty.
const ToolRow& toolRow(Tool tool);

/// The name of a tool as the user reads it: "Stamp".
QString nameOf(Tool tool);
}

#endif

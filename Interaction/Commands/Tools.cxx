// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Commands/Tools.h"

#include "Interaction/Commands/Application.h"

#include <algorithm>

namespace brainshift
{
// Each is in Interaction/Tools, in the file of its tool.
ToolRow moveTool();
ToolRow softTool();
ToolRow stampTool();
ToolRow pullTool();

const std::vector<ToolRow>& toolTable()
{
  static const std::vector<ToolRow> table{
    moveTool(),
    softTool(),
    stampTool(),
    pullTool(),
  };
  return table;
}

const ToolRow& toolRow(Tool tool)
{
  const std::vector<ToolRow>& table = toolTable();
  static const ToolRow none{ Tool::None, {}, "", "", {}, false, {}, {}, nullptr };
  const auto found = std::find_if(
    table.begin(), table.end(), [tool](const ToolRow& row) { return row.tool == tool; });
  return found == table.end() ? none : *found;
}

QString nameOf(Tool tool)
{
  return tr(traitsOf(tool).name);
}

QString ToolRow::icon() const
{
  return ":/BrainShift/" + this->id().toLower() + ".svg";
}

QString ToolRow::tip() const
{
  return tr("%1 Shortcut: %2. Click again to put the tool down.")
    .arg(tr(this->what), QKeySequence(this->key).toString(QKeySequence::NativeText));
}
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Window/StatusLine.h"

#include "Interaction/Commands/ToolSettings.h"
#include "Panel/Tools/MouseHint.h"

namespace brainshift
{
StatusLine::StatusLine(QWidget* parent)
  : QLabel(parent)
{
  this->setObjectName("BrainShiftStatus");
  this->setContentsMargins(6, 0, 6, 0);
  this->connect(ToolSettings::instance(), &ToolSettings::changed, this, &StatusLine::refresh);
  this->refresh();
}

void StatusLine::refresh()
{
  const ToolSettings& settings = *ToolSettings::instance();
  // Without a tool the mouse does what it always does, but for slices.
  const bool isOurs =
    settings.tool() != ToolKind::None || settings.ground() == ToolSettings::Ground::FlatSlices;
  this->setText(isOurs ? mouseHint(settings, settings.ground()) : QString());
  this->setToolTip(this->text());
}
}

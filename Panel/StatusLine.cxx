// SPDX-License-Identifier: BSD-3-Clause
#include "StatusLine.h"

#include "MouseHint.h"
#include "ToolSettings.h"

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
  const bool inHand = settings.tool() != ToolSettings::Tool::None;
  this->setText(inHand ? mouseHint(settings) : QString());
  this->setToolTip(this->text());
}

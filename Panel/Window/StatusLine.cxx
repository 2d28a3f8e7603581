// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Window/StatusLine.h"

#include "Interaction/Commands/ToolSettings.h"
#include "Panel/Tools/MouseHint.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>

namespace brainshift
{
StatusLine::StatusLine(QWidget* parent)
  : QWidget(parent)
  , Switch(new QToolButton(this))
  , Line(new QLabel(this))
{
  const ToolSettings* settings = ToolSettings::instance();
  this->Switch->setObjectName("BrainShiftSwitchVolume");
  this->Switch->setToolTip(
    tr("Select this volume, so that the tool in hand works on it. A click in the view does the "
       "same."));
  this->connect(this->Switch, &QToolButton::clicked, settings, &ToolSettings::switchWanted);
  this->Line->setObjectName("BrainShiftStatus");
  // A long line must not widen the window.
  this->Line->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  auto row = new QHBoxLayout(this);
  row->setContentsMargins(6, 0, 6, 0);
  row->addWidget(this->Switch);
  row->addWidget(this->Line, 1);
  this->connect(settings, &ToolSettings::changed, this, &StatusLine::refresh);
  this->refresh();
}

void StatusLine::refresh()
{
  const ToolSettings& settings = *ToolSettings::instance();
  const bool inHand = settings.tool() != Tool::None;
  // Without a tool the mouse does what it always does, but for slices.
  const bool isOurs = inHand || !settings.request().isEmpty() ||
    settings.ground() == ToolSettings::Ground::FlatSlices;
  this->Line->setText(isOurs ? mouseHint(settings, settings.ground()) : QString());
  this->Line->setToolTip(this->Line->text());
  this->Switch->setText(tr("Work on %1").arg(settings.shownInstead()));
  this->Switch->setVisible(inHand && !settings.shownInstead().isEmpty());
}
}

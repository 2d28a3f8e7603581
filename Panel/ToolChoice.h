// SPDX-License-Identifier: BSD-3-Clause
// The tools as panel and toolbar offer them.
#ifndef BrainShift_ToolChoice_h
#define BrainShift_ToolChoice_h

#include "ToolSettings.h"

#include <QKeySequence>
#include <QList>
#include <QString>

struct ToolChoice
{
  ToolSettings::Tool tool;
  QString id;            // last part of object names
  QString name;          // shown
  QString icon;          // file
  QKeySequence shortcut; // free in ParaView; works in the whole window
  QString what;          // it is for
  QString tip;           // the same, the shortcut, and how to put it down
};

const QList<ToolChoice>& toolChoices(); // Move, Soft, Stamp
#endif

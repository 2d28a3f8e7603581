// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The tools as the panel and the toolbar offer them.
#ifndef BrainShift_ToolChoice_h
#define BrainShift_ToolChoice_h

#include "Interaction/Commands/ToolSettings.h"

#include <QKeySequence>
#include <QList>
#include <QString>

namespace brainshift
{
/// One tool as a button offers it.
struct ToolChoice
{
  ToolKind tool;
  QString id;            ///< Last part of object names; never translated.
  QString name;          ///< Text of the button.
  QString icon;          ///< File among the resources.
  QKeySequence shortcut; ///< Free in ParaView; works in the whole window.
  QString tip;           ///< What the tool is for, its shortcut, and how to put it down.
};

/// Move, Soft, Stamp, Pull.
const QList<ToolChoice>& toolChoices();
}

#endif

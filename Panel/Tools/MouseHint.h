// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The mouse gestures of a view, as one line for the panel and the status bar. The words are those
/// of the table of commands.
#ifndef BrainShift_MouseHint_h
#define BrainShift_MouseHint_h

#include "Interaction/Commands/ToolSettings.h"

namespace brainshift
{
/// The line for the tool in hand over a ground.
QString mouseHint(const ToolSettings& settings, ToolSettings::Ground ground);
}

#endif

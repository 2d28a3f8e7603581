// SPDX-License-Identifier: BSD-3-Clause
// What the mouse does in a view, as one line for panel and status bar.
#ifndef BrainShift_MouseHint_h
#define BrainShift_MouseHint_h

#include "ToolSettings.h"

#include <QString>

QString mouseHint(const ToolSettings& settings, ToolSettings::Ground ground);

#endif

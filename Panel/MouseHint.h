// SPDX-License-Identifier: BSD-3-Clause
// What the mouse does in the view now, as one line for panel and status bar.
#ifndef BrainShift_MouseHint_h
#define BrainShift_MouseHint_h

#include <QString>

class ToolSettings;

QString mouseHint(const ToolSettings& settings);

#endif

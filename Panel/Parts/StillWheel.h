// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A wheel that scrolls a panel and changes no value under the cursor.
#ifndef BrainShift_StillWheel_h
#define BrainShift_StillWheel_h

class QWidget;

namespace brainshift
{
/// From now on a list or a number leaves the wheel to the panel around it, unless it has the
/// keyboard's focus.
void keepStill(QWidget* field);
}

#endif

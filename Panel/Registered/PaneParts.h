// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Buttons and texts that the panes of a registration are made of.
#ifndef BrainShift_PaneParts_h
#define BrainShift_PaneParts_h

#include <QString>

class QLabel;
class QToolButton;

namespace brainshift
{
/// A button that leaves the keyboard where it is when it is clicked.
QToolButton* makeButton(const char* name, const QString& text, const QString& tip);

/// A text that wraps and can be copied.
QLabel* makeText(const char* name);
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A fainter colour for selected rows: icons would be lost on the strong one of most themes.
#ifndef BrainShift_SoftHighlight_h
#define BrainShift_SoftHighlight_h

class QWidget;

namespace brainshift
{
/// Mixes the theme's highlight with the background. Call it again when the palette changed.
void softenHighlight(QWidget* list);
}

#endif

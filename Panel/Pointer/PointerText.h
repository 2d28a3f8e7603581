// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the dock says of the pointer.
#ifndef BrainShift_PointerText_h
#define BrainShift_PointerText_h

#include <QString>

namespace brainshift
{
class Pointer;

/// The connection in a few words: device, rate (Hz), age of the last pose (s), what was lost; or
/// the sentence that says why it ended.
QString connectionText(const Pointer& pointer);
/// Whether connectionText() tells of something that the user must see to.
bool warnsOf(const Pointer& pointer);
/// The distance of the tip to the bent cortex (mm) with its side; or why there is none.
QString distanceText(const Pointer& pointer);
/// The position of the tip (mm, world axes).
QString placeText(const Pointer& pointer);
}

#endif

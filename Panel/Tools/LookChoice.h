// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A look of a volume as panel and toolbar offer it, and what a click on it does.
#ifndef BrainShift_LookChoice_h
#define BrainShift_LookChoice_h

#include <QIcon>
#include <QString>

class pqDataRepresentation;

namespace brainshift
{
/// A small picture of a look.
QIcon iconOfLook(const QString& name);

/// What a look shows, one sentence.
QString tipOfLook(const QString& name);

/// Gives a display a look, as one step to undo, and remembers it for volumes of its kind.
void chooseLook(pqDataRepresentation* display, const QString& name);
}

#endif

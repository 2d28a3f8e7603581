// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Keeps the pictures of Deformed Volumes while a tool is in hand. Hovering then redraws only the
/// outlines over them and casts no rays.
#ifndef BrainShift_KeptPictures_h
#define BrainShift_KeptPictures_h

#include <pqDataRepresentation.h>

#include <QList>
#include <QPointer>

namespace brainshift
{
class KeptPictures
{
public:
  ~KeptPictures() { this->letGo(); }

  /// Keeps the picture of a representation from now on.
  void keep(pqDataRepresentation* display);
  /// Keeps none any more.
  void letGo();

private:
  QList<QPointer<pqDataRepresentation>> Kept;
};
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
// Pictures of Deformed Volumes that are kept while a tool is in hand: then only what lies over them
// changes from event to event, and no rays are cast.
#ifndef BrainShift_KeptPictures_h
#define BrainShift_KeptPictures_h

#include <pqDataRepresentation.h>

#include <QList>
#include <QPointer>

class KeptPictures
{
public:
  ~KeptPictures() { this->letGo(); }

  void keep(pqDataRepresentation* shown);
  void letGo(); // of all

private:
  QList<QPointer<pqDataRepresentation>> Kept;
};

#endif

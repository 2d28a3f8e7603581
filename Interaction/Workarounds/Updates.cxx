// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Workarounds/Updates.h"

#include <pqUndoStack.h>

#include <vtkSMPropertyHelper.h>

namespace brainshift
{
namespace
{
void setKeepPicture(pqDataRepresentation* display, bool keep)
{
  SCOPED_UNDO_EXCLUDE();
  vtkSMPropertyHelper(display->getProxy(), "KeepPicture", true).Set(keep);
  display->getProxy()->UpdateVTKObjects();
}
}

void KeptPictures::keep(pqDataRepresentation* display)
{
  if (!this->Kept.contains(display))
  {
    setKeepPicture(display, true);
    this->Kept.append(display);
  }
}

void KeptPictures::letGo()
{
  for (const QPointer<pqDataRepresentation>& display : this->Kept)
  {
    if (display)
    {
      setKeepPicture(display, false);
    }
  }
  this->Kept.clear();
}
}

// SPDX-License-Identifier: BSD-3-Clause
#include "KeptPictures.h"

#include <pqUndoStack.h>

#include <vtkSMPropertyHelper.h>
#include <vtkSMProxy.h>

namespace
{
void setKeepPicture(pqDataRepresentation* shown, bool keep)
{
  SCOPED_UNDO_EXCLUDE();
  vtkSMPropertyHelper(shown->getProxy(), "KeepPicture", true).Set(keep);
  shown->getProxy()->UpdateVTKObjects();
}
}

void KeptPictures::keep(pqDataRepresentation* shown)
{
  if (!this->Kept.contains(shown))
  {
    setKeepPicture(shown, true);
    this->Kept.append(shown);
  }
}

void KeptPictures::letGo()
{
  for (const QPointer<pqDataRepresentation>& shown : this->Kept)
  {
    if (shown)
    {
      setKeepPicture(shown, false);
    }
  }
  this->Kept.clear();
}

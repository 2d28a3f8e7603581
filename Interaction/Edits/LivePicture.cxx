// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Edits/LivePicture.h"

#include "Interaction/Views/ActiveDeformation.h"
#include "Interaction/Workarounds/Updates.h"

#include <pqApplicationCore.h>
#include <pqPipelineSource.h>
#include <pqProgressManager.h>
#include <pqUndoStack.h>
#include <pqView.h>

#include <vtkSMSession.h>
#include <vtkSMViewProxy.h>

#include <QSignalBlocker>
#include <QWidget>

namespace brainshift
{
void drawRoughly(pqView* view)
{
  vtkSMViewProxy* proxy = view->getViewProxy();
  if (proxy && !proxy->GetSession()->GetPendingProgress() && proxy->GetRenderWindow() &&
    view->widget()->isVisible())
  {
    view->cancelPendingRenders();
    // The progress bar would make the window lay out and paint itself again, and at the end of a
    // picture ParaView requests the sizes of all visible data.
    pqProgressManager* progress = pqApplicationCore::instance()->getProgressManager();
    progress->lockProgress(view);
    {
      const QSignalBlocker quiet(view);
      proxy->InteractiveRender();
    }
    progress->unlockProgress(view);
  }
  else
  {
    view->render();
  }
}

void drawMoving(pqPipelineSource* source, vtkSMProxy* measured)
{
  SCOPED_UNDO_EXCLUDE();
  QuietUpdates quiet;
  if (measured)
  {
    quiet.add(measured);
    measured->UpdateVTKObjects();
  }
  quiet.add(source->getProxy());
  source->getProxy()->UpdateVTKObjects();
  for (pqView* view : viewsShowing(source))
  {
    if (pqDataRepresentation* display = source->getRepresentation(view))
    {
      quiet.add(display->getProxy());
    }
    drawRoughly(view);
  }
}

void drawFully(pqPipelineSource* source)
{
  for (pqView* view : viewsShowing(source))
  {
    view->render();
  }
}
}

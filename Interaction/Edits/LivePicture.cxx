// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Edits/LivePicture.h"

#include "Interaction/Commands/Application.h"
#include "Interaction/Views/ActiveDeformation.h"
#include "Interaction/Views/ServerPicture.h"
#include "Interaction/Workarounds/Updates.h"

#include <pqApplicationCore.h>
#include <pqOutputPort.h>
#include <pqPipelineSource.h>
#include <pqProgressManager.h>
#include <pqUndoStack.h>
#include <pqView.h>

#include <vtkClientServerStream.h>
#include <vtkPVRenderView.h>
#include <vtkPVSession.h>
#include <vtkSMSession.h>
#include <vtkSMViewProxy.h>

#include <QSet>
#include <QSignalBlocker>
#include <QWidget>

#include <algorithm>
#include <vector>

namespace brainshift
{
namespace
{
// Adds the displays by which a view shows a source and what is made of it.
void addDisplays(pqPipelineSource* source, pqView* view, QSet<pqPipelineSource*>& seen,
  std::vector<pqDataRepresentation*>& displays)
{
  if (!source || seen.contains(source))
  {
    return;
  }
  seen.insert(source);
  for (pqOutputPort* port : source->getOutputPorts())
  {
    for (pqDataRepresentation* display : port->getRepresentations(view))
    {
      if (display->isVisible())
      {
        displays.push_back(display);
      }
    }
  }
  for (pqPipelineSource* consumer : source->getAllConsumers())
  {
    addDisplays(consumer, view, seen, displays);
  }
}

// Whether one server has the data and draws a moving picture of it, and no display but bent volumes
// changes.
bool isDrawnByServer(pqView* view, const std::vector<pqDataRepresentation*>& displays)
{
  vtkSMProxy* proxy = view->getProxy();
  vtkSMSession* session = proxy->GetSession();
  auto drawn = vtkPVRenderView::SafeDownCast(proxy->GetClientSideObject());
  constexpr vtkTypeUInt32 Servers = vtkPVSession::DATA_SERVER | vtkPVSession::RENDER_SERVER;
  return drawn && !displays.empty() && (drawn->GetInteractiveRenderProcesses() & Servers) != 0 &&
    session->IsA("vtkSMSessionClient") &&
    session->GetController(vtkPVSession::DATA_SERVER_ROOT) ==
    session->GetController(vtkPVSession::RENDER_SERVER_ROOT) &&
    std::all_of(displays.begin(), displays.end(),
      [](pqDataRepresentation* display) { return showsVolume(display) || showsSlices(display); });
}

// InteractiveRender updates the view first: the server is asked for sizes, bounds and progress, one
// round trip after the other. This asks for the picture alone, in one round trip. The displays
// bring their data on the way (vtkWholeVolumeRepresentation); the next update of the view does the
// rest.
void drawAhead(vtkSMViewProxy* view, const std::vector<pqDataRepresentation*>& displays)
{
  vtkSMSession* session = view->GetSession();
  auto drawn = vtkPVRenderView::SafeDownCast(view->GetClientSideObject());
  session->PrepareProgress();
  for (pqDataRepresentation* display : displays)
  {
    vtkSMProxy* proxy = display->getProxy();
    vtkClientServerStream stream;
    stream << vtkClientServerStream::Invoke << VTKOBJECT(proxy) << "MarkModified"
           << vtkClientServerStream::End;
    session->ExecuteStream(proxy->GetLocation(), stream);
  }
  vtkClientServerStream stream;
  stream << vtkClientServerStream::Invoke << VTKOBJECT(view) << "InteractiveRender"
         << vtkClientServerStream::End;
  session->ExecuteStream(drawn->GetInteractiveRenderProcesses(), stream);
  session->CleanupPendingProgress();
}

// `changed`: what the view shows that is not up to date.
void draw(pqView* view, const std::vector<pqDataRepresentation*>& changed)
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
    if (isDrawnByServer(view, changed))
    {
      ServerPicture::drawOver(view);
      drawAhead(proxy, changed);
    }
    else
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
}

void drawRoughly(pqView* view)
{
  draw(view, {});
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
    QSet<pqPipelineSource*> seen;
    std::vector<pqDataRepresentation*> changed;
    addDisplays(source, view, seen, changed);
    addDisplays(measured ? serverManagerModel()->findItem<pqPipelineSource*>(measured) : nullptr,
      view, seen, changed);
    draw(view, changed);
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

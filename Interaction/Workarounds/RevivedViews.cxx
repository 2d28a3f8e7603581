// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Workarounds/RevivedViews.h"

#include "Interaction/Workarounds/Sessions.h"

#include <pqApplicationCore.h>
#include <pqServerManagerModel.h>
#include <pqUndoStack.h>
#include <pqView.h>

#include <vtkSMProperty.h>
#include <vtkSMRenderViewProxy.h>

#include <QTimer>

namespace brainshift
{
namespace
{
constexpr const char* Looks[] = { "InteractionMode", "CameraPosition", "CameraFocalPoint",
  "CameraViewUp", "CameraViewAngle", "CameraParallelScale", "CameraParallelProjection",
  "CenterOfRotation", "UseColorPaletteForBackground", "BackgroundColorMode", "Background",
  "Background2", "OrientationAxesVisibility", "CenterAxesVisibility" };
}

RevivedViews::RevivedViews(QObject* parent)
  : QObject(parent)
{
  pqServerManagerModel* model = pqApplicationCore::instance()->getServerManagerModel();
  QObject::connect(model, &pqServerManagerModel::preViewRemoved, this, &RevivedViews::keep);
  onNewSession(this, [this] { this->Kept.clear(); });
  // Later: undo sets properties of the view after it has come back.
  QObject::connect(model, &pqServerManagerModel::viewAdded, this, [this](pqView* view) {
    if (this->Kept.count(view->getProxy()->GetGlobalID()) > 0)
    {
      QTimer::singleShot(0, view, [this, view] { this->restore(view); });
    }
  });
}

RevivedViews::~RevivedViews() = default;

void RevivedViews::keep(pqView* going)
{
  auto proxy = vtkSMRenderViewProxy::SafeDownCast(going->getProxy());
  if (!proxy)
  {
    return;
  }
  proxy->SynchronizeCameraProperties();
  Properties& kept = this->Kept[proxy->GetGlobalID()];
  kept.clear();
  for (const char* name : Looks)
  {
    if (vtkSMProperty* property = proxy->GetProperty(name))
    {
      kept[name] = property;
    }
  }
}

void RevivedViews::restore(pqView* back)
{
  vtkSMProxy* proxy = back->getProxy();
  const auto kept = this->Kept.find(proxy->GetGlobalID());
  if (kept == this->Kept.end())
  {
    return;
  }
  SCOPED_UNDO_EXCLUDE();
  for (const auto& [name, property] : kept->second)
  {
    proxy->GetProperty(name.c_str())->Copy(property);
  }
  proxy->UpdateVTKObjects();
  this->Kept.erase(kept);
  back->render();
}
}

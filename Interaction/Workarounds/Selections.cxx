// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Workarounds/Selections.h"

#include <pqActiveObjects.h>
#include <pqApplicationCore.h>
#include <pqDataRepresentation.h>
#include <pqPipelineSource.h>
#include <pqServerManagerModel.h>
#include <pqUndoStack.h>

#include <vtkSMPropertyHelper.h>
#include <vtkSMProxySelectionModel.h>
#include <vtkSMSourceProxy.h>

#include <QPointer>
#include <QTimer>

namespace brainshift
{
namespace
{
// pqActiveObjects keeps what is selected where it is told to select nothing.
void selectNothing()
{
  if (auto selected = pqActiveObjects::instance().activeSourcesSelectionModel())
  {
    selected->Select(nullptr, vtkSMProxySelectionModel::CLEAR);
  }
}
}

KeptSelection::KeptSelection(QObject* parent)
  : QObject(parent)
{
  pqServerManagerModel* model = pqApplicationCore::instance()->getServerManagerModel();
  const auto keep = [this](pqPipelineSource*, pqPipelineSource* consumer) { this->keep(consumer); };
  this->connect(model, &pqServerManagerModel::preConnectionAdded, this, keep);
  this->connect(model, &pqServerManagerModel::preConnectionRemoved, this, keep);
  this->connect(model, &pqServerManagerModel::aboutToRemoveServer, this, [this, model] {
    // Connected last, so that it comes after all lists.
    this->Dropping =
      this->connect(model, &pqServerManagerModel::sourceRemoved, this, selectNothing);
  });
  this->connect(model, &pqServerManagerModel::serverRemoved, this,
    [this] { QObject::disconnect(this->Dropping); });
}

// Later, when the pipeline browser has moved the filter. A later selection is kept.
void KeptSelection::keep(pqPipelineSource* consumer)
{
  if (pqActiveObjects::instance().selection() != pqProxySelection{ consumer })
  {
    return;
  }
  QTimer::singleShot(0, this, [kept = QPointer<pqPipelineSource>(consumer)] {
    pqActiveObjects& active = pqActiveObjects::instance();
    // The filter can be selected and yet not be the active source.
    const bool isActive = active.activeSource() == kept;
    const bool isAlone = active.selection() == pqProxySelection{ kept.data() };
    if (kept && (active.selection().isEmpty() || (isAlone && !isActive)))
    {
      active.setSelection({ kept }, kept);
    }
  });
}

namespace
{
constexpr char Visible[] = "SelectionVisibility";

bool isAnythingSelected(pqPipelineSource* source)
{
  vtkSMSourceProxy* proxy = source->getSourceProxy();
  for (unsigned int port = 0; port < proxy->GetNumberOfOutputPorts(); ++port)
  {
    if (proxy->GetSelectionInput(port))
    {
      return true;
    }
  }
  return false;
}

void showSelection(vtkSMProxy* representation, int visible)
{
  vtkSMPropertyHelper(representation, Visible).Set(visible);
  representation->UpdateVTKObjects();
}
}

void EmptySelections::leaveOut(pqPipelineSource* source)
{
  this->putBack();
  if (isAnythingSelected(source))
  {
    return;
  }
  SCOPED_UNDO_EXCLUDE();
  for (pqView* view : source->getViews())
  {
    pqDataRepresentation* display = source->getRepresentation(view);
    vtkSMProxy* proxy = display ? display->getProxy() : nullptr;
    if (proxy && proxy->GetProperty(Visible))
    {
      showSelection(proxy, 0);
      this->Representations.emplace_back(proxy);
    }
  }
}

void EmptySelections::putBack()
{
  if (this->Representations.empty())
  {
    return; // at the end of the application there is no undo stack
  }
  SCOPED_UNDO_EXCLUDE();
  for (const vtkWeakPointer<vtkSMProxy>& representation : this->Representations)
  {
    if (representation)
    {
      showSelection(representation, 1);
    }
  }
  this->Representations.clear();
}
}

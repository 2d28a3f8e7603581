// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Workarounds/EmptySelections.h"

#include <pqDataRepresentation.h>
#include <pqPipelineSource.h>
#include <pqUndoStack.h>

#include <vtkSMPropertyHelper.h>
#include <vtkSMSourceProxy.h>

namespace brainshift
{
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

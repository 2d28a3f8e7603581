// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Workarounds/ParaViewFaults.h"

#include "vtkCommand.h"
#include "vtkInformation.h"
#include "vtkInformationRequestKey.h"
#include "vtkOutputWindow.h"
#include "vtkPVDataDeliveryManager.h"
#include "vtkPVDataRepresentation.h"
#include "vtkPVRenderViewDataDeliveryManager.h"
#include "vtkPVSessionBase.h"
#include "vtkPVView.h"
#include "vtkProcessModule.h"
#include "vtkSession.h"

namespace brainshift
{
void deliverWithStandIns(
  vtkPVDataRepresentation* representation, vtkInformationRequestKey* request, vtkInformation* input)
{
  auto view = vtkPVView::SafeDownCast(input->Get(vtkPVView::VIEW()));
  if (view && request == vtkPVView::REQUEST_UPDATE_LOD())
  {
    const unsigned int id = representation->GetUniqueIdentifier();
    unsigned int volumeAndOutline[] = { id, 0, id, 1 }; // their ports
    view->GetDeliveryManager()->Deliver(/*use_low_res*/ 0, 4, volumeAndOutline);
  }
}

void deliverNow(vtkPVDataRepresentation* representation, vtkPVView* view)
{
  vtkPVDataDeliveryManager* delivery = view->GetDeliveryManager();
  unsigned int volume[] = { representation->GetUniqueIdentifier(), 0 }; // and its port
  delivery->Deliver(/*use_low_res*/ 0, 2, volume);
  auto ordered = vtkPVRenderViewDataDeliveryManager::SafeDownCast(delivery);
  if (ordered && ordered->GetUseRedistributedDataAsDeliveredData())
  {
    ordered->RedistributeDataForOrderedCompositing(/*use_lod*/ false);
  }
}

namespace
{
constexpr const char* ServerEnded =
  "BrainShift: the server has ended, or the connection to it is lost. Nothing more is computed or "
  "drawn. The strokes are still in this process. Save State (SaveState in Python) keeps them, and "
  "Load State (LoadState) brings them back on another server.\n";

void sayOnce(vtkObject* session, unsigned long, void*, void*);

vtkCallbackCommand* message()
{
  static const vtkNew<vtkCallbackCommand> command;
  command->SetCallback(sayOnce);
  return command;
}

// Each picture that is asked for after that fails again.
void sayOnce(vtkObject* session, unsigned long, void*, void*)
{
  session->RemoveObserver(message());
  vtkOutputWindowDisplayErrorText(ServerEnded);
}
}

void watchServer()
{
  vtkProcessModule* process = vtkProcessModule::GetProcessModule();
  vtkSession* session = process ? process->GetSession() : nullptr;
  if (session && !session->HasObserver(vtkPVSessionBase::ConnectionLost, message()))
  {
    session->AddObserver(vtkPVSessionBase::ConnectionLost, message());
  }
}

FailedUpdate::FailedUpdate(
  vtkPVDataRepresentation* representation, vtkInformationRequestKey* request)
  : Representation(representation)
  , Asked(request == vtkPVView::REQUEST_UPDATE() && representation->GetNeedsUpdate())
  , DataTime(representation->GetPipelineDataTime())
{
  this->Skipped->SetClientData(this);
  this->Skipped->SetCallback([](vtkObject*, unsigned long, void* self, void*) {
    static_cast<FailedUpdate*>(self)->Asked = false; // an animation has kept the data
  });
  representation->AddObserver(vtkPVDataRepresentation::SkippedUpdateDataEvent, this->Skipped);
}

FailedUpdate::~FailedUpdate()
{
  this->Representation->RemoveObserver(this->Skipped);
}

void FailedUpdate::end()
{
  if (this->Asked && this->Representation->GetPipelineDataTime() == this->DataTime)
  {
    this->Representation->InvokeEvent(vtkCommand::UpdateDataEvent);
  }
}
}

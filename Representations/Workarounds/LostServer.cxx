// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Workarounds/LostServer.h"

#include "vtkCallbackCommand.h"
#include "vtkNew.h"
#include "vtkOutputWindow.h"
#include "vtkPVSessionBase.h"
#include "vtkProcessModule.h"
#include "vtkSession.h"

namespace brainshift
{
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
}

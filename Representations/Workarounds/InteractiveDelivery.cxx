// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Workarounds/InteractiveDelivery.h"

#include "vtkInformation.h"
#include "vtkInformationRequestKey.h"
#include "vtkPVDataDeliveryManager.h"
#include "vtkPVDataRepresentation.h"
#include "vtkPVView.h"

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
}

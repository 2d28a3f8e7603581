// SPDX-License-Identifier: BSD-3-Clause
#ifndef BrainShift_InteractiveDelivery_h
#define BrainShift_InteractiveDelivery_h

class vtkInformation;
class vtkInformationRequestKey;
class vtkPVDataRepresentation;

namespace brainshift
{
// To be called by a representation of a volume after its base class has answered a view's request.
// Above its LOD threshold ParaView delivers an interactive picture the data's stand-ins only. A
// volume has none, and would be missing after a stroke; so it is delivered itself.
void deliverWithStandIns(vtkPVDataRepresentation* representation, vtkInformationRequestKey* request,
  vtkInformation* input);
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Delivers volumes for interactive pictures, too.
 */
#ifndef BrainShift_InteractiveDelivery_h
#define BrainShift_InteractiveDelivery_h

class vtkInformation;
class vtkInformationRequestKey;
class vtkPVDataRepresentation;

namespace brainshift
{
/// A representation of a volume calls this after its base class has answered a view's request.
/// Above its LOD threshold, ParaView delivers only simplified stand-ins of the data for interactive
/// pictures. A volume has no stand-in and would be missing after a stroke. So this delivers the
/// volume itself.
void deliverWithStandIns(vtkPVDataRepresentation* representation, vtkInformationRequestKey* request,
  vtkInformation* input);
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What undoes faults of ParaView in representations; see README.md.
#ifndef BrainShift_ParaViewFaults_h
#define BrainShift_ParaViewFaults_h

#include "vtkCallbackCommand.h"
#include "vtkNew.h"
#include "vtkType.h"

class vtkInformation;
class vtkInformationRequestKey;
class vtkPVDataRepresentation;
class vtkPVView;

namespace brainshift
{
/// A representation of a volume calls this after its base class has answered a view's request.
/// Above its LOD threshold, ParaView delivers only simplified stand-ins of the data for interactive
/// pictures. A volume has no stand-in and would be missing after a stroke. So this delivers the
/// volume itself.
void deliverWithStandIns(vtkPVDataRepresentation* representation, vtkInformationRequestKey* request,
  vtkInformation* input);

/// Delivers a volume that came after the view's update. ParaView takes what it gives to the ranks
/// of an ordered picture before it asks representations, so this takes it again.
void deliverNow(vtkPVDataRepresentation* representation, vtkPVView* view);

/**
 * Watches the connection to the server of the active session. When it is lost, one message reports
 * it and tells how to keep the strokes. Without it, ParaView's sockets report only "Broken pipe".
 * In a session without a server this does nothing.
 */
void watchServer();

/**
 * Ends an update that failed because a filter refused its values. ParaView ends only updates that
 * brought data. After any other it believes that the representation still waits, and passes on no
 * further change, so that the picture would stay as it was even with valid values.
 *
 * Make one before the base class answers a request of the view, and call end() after it.
 */
class FailedUpdate
{
public:
  FailedUpdate(vtkPVDataRepresentation* representation, vtkInformationRequestKey* request);
  ~FailedUpdate();

  /** Reports to ParaView that the update has ended, if it was requested and brought no data. */
  void end();

private:
  vtkPVDataRepresentation* Representation;
  bool Asked;
  vtkMTimeType DataTime;
  vtkNew<vtkCallbackCommand> Skipped;
};
}

#endif

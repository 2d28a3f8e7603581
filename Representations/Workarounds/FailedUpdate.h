// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Lets a representation hear of later changes after its input could not be made.
 */
#ifndef BrainShift_FailedUpdate_h
#define BrainShift_FailedUpdate_h

#include "vtkCallbackCommand.h"
#include "vtkNew.h"
#include "vtkType.h"

class vtkInformationRequestKey;
class vtkPVDataRepresentation;

namespace brainshift
{
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

  /** Says to ParaView that the update has ended, if it was asked for and brought no data. */
  void end();

private:
  vtkPVDataRepresentation* Representation;
  bool Asked;
  vtkMTimeType DataTime;
  vtkNew<vtkCallbackCommand> Skipped;
};
}

#endif

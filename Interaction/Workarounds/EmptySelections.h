// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Turns off the display of a selection while nothing is selected. ParaView updates that display
/// with each change of the data. During a drag it takes a tenth of the main thread's time.
#ifndef BrainShift_EmptySelections_h
#define BrainShift_EmptySelections_h

#include <vtkSMProxy.h>
#include <vtkWeakPointer.h>

#include <vector>

class pqPipelineSource;

namespace brainshift
{
class EmptySelections
{
public:
  EmptySelections() = default;
  ~EmptySelections() { this->putBack(); }
  EmptySelections(const EmptySelections&) = delete;
  EmptySelections& operator=(const EmptySelections&) = delete;

  /// Turns the display off in every view that shows the source.
  void leaveOut(pqPipelineSource* source);
  /// Turns the display on again.
  void putBack();

private:
  std::vector<vtkWeakPointer<vtkSMProxy>> Representations; ///< Those whose selection is off.
};
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
// Leaves out what would show a selection of a deformation while nothing of it is selected. ParaView
// brings that up to date with every change: a tenth of the main thread's time in a drag.
#ifndef BrainShift_EmptySelections_h
#define BrainShift_EmptySelections_h

#include <vtkSMProxy.h>
#include <vtkWeakPointer.h>

#include <vector>

class pqPipelineSource;

class EmptySelections
{
public:
  EmptySelections() = default;
  ~EmptySelections() { this->putBack(); }
  EmptySelections(const EmptySelections&) = delete;
  EmptySelections& operator=(const EmptySelections&) = delete;

  // In every view that shows the source.
  void leaveOut(pqPipelineSource* source);
  void putBack();

private:
  std::vector<vtkWeakPointer<vtkSMProxy>> Representations; // without their selection
};

#endif

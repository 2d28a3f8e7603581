// SPDX-License-Identifier: BSD-3-Clause
// While a stroke is edited, ParaView need not bring up to date what would show a selection of the
// deformation where nothing of it is selected: that is a tenth of what a picture of a drag takes
// the main thread.
#ifndef BrainShift_EmptySelections_h
#define BrainShift_EmptySelections_h

#include <vtkSMProxy.h>
#include <vtkWeakPointer.h>

#include <vector>

class pqPipelineSource;

class EmptySelections
{
public:
  ~EmptySelections() { this->putBack(); }

  // In every view that shows the source.
  void leaveOut(pqPipelineSource* source);
  void putBack();

private:
  std::vector<vtkWeakPointer<vtkSMProxy>> Representations; // without their selection
};

#endif

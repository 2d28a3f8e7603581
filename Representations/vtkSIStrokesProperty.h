// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class vtkSIStrokesProperty
 * @brief Hands all strokes to Free-Form Deformation in one call.
 *
 * ParaView calls a method of the filter for each number of a property that repeats. 10 000 strokes
 * are 140 000 calls, which take a second for each step of a drag.
 */
#ifndef vtkSIStrokesProperty_h
#define vtkSIStrokesProperty_h

#include "vtkBrainShiftRepresentationsModule.h" // for the export macro
#include "vtkSIDoubleVectorProperty.h"

class VTKBRAINSHIFTREPRESENTATIONS_EXPORT vtkSIStrokesProperty : public vtkSIDoubleVectorProperty
{
public:
  static vtkSIStrokesProperty* New();
  vtkTypeMacro(vtkSIStrokesProperty, vtkSIDoubleVectorProperty);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkSIStrokesProperty() = default;
  ~vtkSIStrokesProperty() override = default;

  bool Push(vtkSMMessage* message, int offset) override;

private:
  vtkSIStrokesProperty(const vtkSIStrokesProperty&) = delete;
  void operator=(const vtkSIStrokesProperty&) = delete;
};

#endif

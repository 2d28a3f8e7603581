// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSIStrokesProperty.h"

#include "Common/Guard.h"
#include "vtkFreeFormDeformation.h"

#include "vtkObjectFactory.h"
#include "vtkSMMessage.h"

#include <vector>

vtkStandardNewMacro(vtkSIStrokesProperty);

bool vtkSIStrokesProperty::Push(vtkSMMessage* message, int offset)
{
  auto* filter = vtkFreeFormDeformation::SafeDownCast(this->GetVTKObject());
  if (!filter)
  {
    return this->Superclass::Push(message, offset);
  }
  return brainshift::guarded(this, false, [&] {
    this->SaveValueToCache(message, offset);
    const auto& numbers = message->GetExtension(ProxyState::property, offset).value().float64();
    filter->SetStrokeNumbers(std::vector<double>(numbers.begin(), numbers.end()));
    return true;
  });
}

void vtkSIStrokesProperty::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}

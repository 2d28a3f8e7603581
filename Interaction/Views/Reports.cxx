// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Views/Reports.h"

#include "Interaction/Workarounds/Sessions.h"

#include <pqUndoStack.h>

#include <vtkSMProperty.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMProxy.h>
#include <vtkSMSessionProxyManager.h>

namespace brainshift
{
vtkSmartPointer<vtkSMProxy> makeReport(vtkSMProxy* beside, const char* name)
{
  SCOPED_UNDO_EXCLUDE();
  auto report = vtk::TakeSmartPointer(
    beside->GetSession() ? beside->GetSessionProxyManager()->NewProxy("misc", name) : nullptr);
  report->PrototypeOn(); // questions are no steps to undo
  return report;
}

void pointAt(vtkSMProxy* report, const char* property, vtkSMProxy* about)
{
  vtkSMPropertyHelper helper(report, property);
  if (helper.GetNumberOfElements() != 1 || helper.GetAsProxy() != about)
  {
    helper.Set(about);
  }
}

void askAnew(vtkSMProxy* report, const char* property)
{
  report->UpdateVTKObjects();
  report->UpdateProperty(property, /*force*/ 1);
}

namespace
{
vtkSMPropertyHelper askedAnew(vtkSMProxy* report, const char* property)
{
  report->UpdateVTKObjects();
  pull(report, report->GetProperty(property));
  return vtkSMPropertyHelper(report, property);
}
}

std::vector<double> answerOf(vtkSMProxy* report, const char* property)
{
  return askedAnew(report, property).GetDoubleArray();
}

QString textOf(vtkSMProxy* report, const char* property)
{
  return QString::fromUtf8(askedAnew(report, property).GetAsString());
}
}

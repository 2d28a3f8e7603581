// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Displays/EvidenceSwitch.h"

#include "Interaction/Commands/Application.h"

#include <pqRepresentation.h>

#include <vtkCommand.h>
#include <vtkSMProperty.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMProxy.h>

#include <cstring>

namespace brainshift
{
namespace
{
vtkSMProxy* inputOf(vtkSMProxy* source, const char* name)
{
  return vtkSMPropertyHelper(source, name, /*quiet*/ true).GetAsProxy();
}

bool is(vtkSMProxy* proxy, const char* name)
{
  return std::strcmp(proxy->GetXMLName(), name) == 0;
}

// The fit that deforms the volume of a display; null if none does.
vtkSMProxy* fitOf(vtkSMProxy* display)
{
  vtkSMProxy* source = inputOf(display, "Input");
  while (source && !is(source, "FreeFormDeformation"))
  {
    source = inputOf(source, "Input");
  }
  vtkSMProxy* lattice = source ? inputOf(source, "Lattice") : nullptr;
  return lattice && is(lattice, "FitDeformation") ? lattice : nullptr;
}
}

EvidenceSwitch::EvidenceSwitch(QObject* parent)
  : QObject(parent)
{
  pqServerManagerModel* model = serverManagerModel();
  QObject::connect(model, &pqServerManagerModel::representationAdded, this, &EvidenceSwitch::watch);
}

void EvidenceSwitch::watch(pqRepresentation* display)
{
  vtkSMProxy* proxy = display->getProxy();
  if (vtkSMProperty* property = proxy->GetProperty("ShowEvidence"))
  {
    this->Connector->Connect(property, vtkCommand::ModifiedEvent, this,
      SLOT(note(vtkObject*, unsigned long, void*)), proxy);
    this->Connector->Connect(proxy, vtkCommand::UpdateEvent, this, SLOT(follow(vtkObject*)));
  }
}

void EvidenceSwitch::note(vtkObject*, unsigned long, void* display)
{
  this->Changed.insert(display);
}

// An undo or a state file sets the property of the fit itself.
void EvidenceSwitch::follow(vtkObject* object)
{
  auto display = vtkSMProxy::SafeDownCast(object);
  if (!display || !this->Changed.remove(object) ||
    pqApplicationCore::instance()->isLoadingState() || isReplayed() ||
    vtkSMPropertyHelper(display, "ShowEvidence").GetAsInt() == 0)
  {
    return;
  }
  vtkSMProxy* fit = fitOf(display);
  if (fit && vtkSMPropertyHelper(fit, "Evidence").GetAsInt() == 0)
  {
    vtkSMPropertyHelper(fit, "Evidence").Set(1);
    fit->UpdateVTKObjects();
  }
}
}

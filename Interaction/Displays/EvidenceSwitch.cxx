// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Displays/EvidenceSwitch.h"

#include "Interaction/Commands/Application.h"

#include <pqRepresentation.h>

#include <vtkCommand.h>
#include <vtkSMProperty.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMProxy.h>

#include <cstring>
#include <vector>

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

// The fits that deform a volume: one, or one for each of the moments of a surgery.
void addFits(vtkSMProxy* source, std::vector<vtkSMProxy*>& fits)
{
  if (is(source, "FreeFormDeformation"))
  {
    vtkSMProxy* lattice = inputOf(source, "Lattice");
    if (lattice && is(lattice, "FitDeformation"))
    {
      fits.push_back(lattice);
    }
    return;
  }
  vtkSMPropertyHelper inputs(source, "Input", /*quiet*/ true);
  for (unsigned int i = 0; i < inputs.GetNumberOfElements(); ++i)
  {
    if (vtkSMProxy* input = inputs.GetAsProxy(i))
    {
      addFits(input, fits);
    }
  }
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
  std::vector<vtkSMProxy*> fits;
  if (vtkSMProxy* source = inputOf(display, "Input"))
  {
    addFits(source, fits);
  }
  for (vtkSMProxy* fit : fits)
  {
    if (vtkSMPropertyHelper(fit, "Evidence").GetAsInt() == 0)
    {
      vtkSMPropertyHelper(fit, "Evidence").Set(1);
      fit->UpdateVTKObjects();
    }
  }
}
}

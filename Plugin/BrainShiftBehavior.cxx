// SPDX-License-Identifier: BSD-3-Clause
#include "BrainShiftBehavior.h"

#include "Interaction/Cases/SlicerScenes.h"
#include "Interaction/Displays/EvidenceSwitch.h"
#include "Interaction/Displays/FinerDetail.h"
#include "Interaction/Landmarks/LandmarkMarks.h"
#include "Interaction/ToolCarrier.h"
#include "Interaction/ToolKeys.h"
#include "Interaction/Views/SliceMouse.h"
#include "Interaction/Workarounds/QuietLinks.h"
#include "Interaction/Workarounds/RevivedViews.h"
#include "Interaction/Workarounds/Selections.h"
#include "Interaction/Workarounds/Sessions.h"
#include "Interaction/Workarounds/UndoneLayouts.h"
#include "Plugin/ComparisonLegend.h"
#include "Plugin/FirstLook.h"
#include "Plugin/SliceGreys.h"

#include "Interaction/Commands/Application.h"

#include <pqActiveObjects.h>
#include <pqPipelineSource.h>
#include <pqUndoStack.h>

#include <vtkSMPVRepresentationProxy.h>
#include <vtkSMPropertyHelper.h>

#include <QVariant>

#include <cstring>

namespace
{
constexpr const char* Shaded = "BrainShiftShaded"; // Qt property of a representation

// `kind`: of a representation.
bool isShownAs(vtkSMProxy* representation, const char* kind)
{
  const char* type = vtkSMPropertyHelper(representation, "Representation").GetAsString();
  return type && std::strcmp(type, kind) == 0;
}

bool reportsNumbers(vtkSMProxy* filter)
{
  return std::strcmp(filter->GetXMLName(), "InvertDisplacementField") == 0;
}

// A state that is being loaded sets its own displays.
void prepare(pqRepresentation* display)
{
  auto representation = vtkSMPVRepresentationProxy::SafeDownCast(display->getProxy());
  const bool volume = representation && isShownAs(representation, "Deformed Volume");
  const bool slices = representation && isShownAs(representation, "Deformed Slices");
  auto data = qobject_cast<pqDataRepresentation*>(display);
  if (data && !pqApplicationCore::instance()->isLoadingState())
  {
    slices ? brainshift::keepGreysSoon(data) : brainshift::takeColorsBack(data);
  }
  if (!(volume || slices) || pqApplicationCore::instance()->isLoadingState())
  {
    return;
  }
  if (!representation->GetUsingScalarColoring() && data)
  {
    volume ? brainshift::showFirstLook(data) : brainshift::colorByFirstArray(data);
  }
  if (volume && !display->property(Shaded).toBool()) // once: the user may turn it off
  {
    display->setProperty(Shaded, true);
    if (representation->GetUsingScalarColoring() && data)
    {
      brainshift::joinLook(data);
    }
    vtkSMPropertyHelper(representation, "Shade", /*quiet*/ true).Set(1);
  }
  representation->UpdateVTKObjects();
}
}

BrainShiftBehavior::BrainShiftBehavior(QObject* parent)
  : QObject(parent)
{
}

void BrainShiftBehavior::onStartup()
{
  pqServerManagerModel* model = brainshift::serverManagerModel();
  QObject::connect(model, &pqServerManagerModel::representationAdded, this,
    &BrainShiftBehavior::watchRepresentation);
  QObject::connect(
    model, &pqServerManagerModel::sourceAdded, this, &BrainShiftBehavior::watchSource);
  brainshift::SliceMouse::watchViews(this);
  new brainshift::KeptSelection(this);
  new brainshift::LandmarkMarks(this);
  new brainshift::QuietLinks(this);
  new brainshift::KeptColors(this);
  new brainshift::RevivedViews(this);
  new brainshift::UndoneLayouts(this);
  new brainshift::WaitingEditors(this);
  new brainshift::ComparisonLegend(this);
  new brainshift::SlicerScenes(this);
  new brainshift::EvidenceSwitch(this);
  new brainshift::FinerDetail(this);
  this->Hand = new brainshift::ToolCarrier(this);
  new brainshift::ToolKeys(this->Hand);
}

void BrainShiftBehavior::onShutdown()
{
  delete this->Hand;
  QObject::disconnect(brainshift::serverManagerModel(), nullptr, this, nullptr);
}

void BrainShiftBehavior::watchRepresentation(pqRepresentation* representation)
{
  auto display = qobject_cast<pqDataRepresentation*>(representation);
  if (!display || !display->getProxy()->GetProperty("Representation"))
  {
    return;
  }
  QObject::connect(display, &pqDataRepresentation::representationTypeModified, this,
    [display] { prepare(display); });
  // The user may choose an array that a look colours.
  QObject::connect(display, &pqDataRepresentation::colorTransferFunctionModified, this,
    [display] { brainshift::keepGreysSoon(display); });
  prepare(display);
  if (!pqApplicationCore::instance()->isLoadingState() && !brainshift::isReplayed())
  {
    // Once there is something to colour, and ParaView has chosen colours of its own.
    QObject::connect(
      display, &pqDataRepresentation::dataUpdated, this,
      [display] {
        QTimer::singleShot(0, display, [display] {
          SCOPED_UNDO_SET("Show distances"); // one step, not one for each property
          brainshift::showByDistance(display);
        });
      },
      Qt::SingleShotConnection);
  }
}

void BrainShiftBehavior::watchSource(pqPipelineSource* source)
{
  if (!reportsNumbers(source->getProxy()))
  {
    return;
  }
  QObject::connect(source, qOverload<pqPipelineSource*>(&pqPipelineSource::dataUpdated), this,
    [](pqPipelineSource* updated) {
      if (updated == pqActiveObjects::instance().activeSource()) // else the panel does not show it
      {
        brainshift::pull(updated->getProxy());
      }
    });
}

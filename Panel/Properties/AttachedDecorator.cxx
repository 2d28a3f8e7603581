// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Properties/AttachedDecorator.h"

#include "Interaction/Commands/Application.h"

#include <pqPropertyWidget.h>

#include <vtkDataObject.h>
#include <vtkPVDataInformation.h>
#include <vtkPVXMLElement.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMSourceProxy.h>

namespace brainshift
{
AttachedDecorator::AttachedDecorator(vtkPVXMLElement* xml, pqPropertyWidget* parent)
  : pqPropertyWidgetDecorator(xml, parent)
  , Array(xml->GetAttributeOrEmpty("array"))
{
  // Apply of the filter may attach the array, or take it away.
  this->connect(serverManagerModel(), &pqServerManagerModel::dataUpdated, this,
    &AttachedDecorator::enableStateChanged);
}

bool AttachedDecorator::enableWidget() const
{
  const vtkSMPropertyHelper input(this->parentWidget()->proxy(), "Input");
  auto source = vtkSMSourceProxy::SafeDownCast(input.GetAsProxy());
  return source &&
    source->GetDataInformation(input.GetOutputPort())
      ->GetArrayInformation(this->Array.c_str(), vtkDataObject::FIELD);
}
}

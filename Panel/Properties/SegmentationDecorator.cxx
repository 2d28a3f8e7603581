// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Properties/SegmentationDecorator.h"

#include "Filters/Attached/Segmentation.h"

#include <pqApplicationCore.h>
#include <pqPropertyWidget.h>
#include <pqServerManagerModel.h>

#include <vtkDataObject.h>
#include <vtkPVDataInformation.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMSourceProxy.h>

namespace brainshift
{
SegmentationDecorator::SegmentationDecorator(vtkPVXMLElement* xml, pqPropertyWidget* parent)
  : pqPropertyWidgetDecorator(xml, parent)
{
  // Apply of the filter may give its output a segmentation, or take it away.
  this->connect(pqApplicationCore::instance()->getServerManagerModel(),
    &pqServerManagerModel::dataUpdated, this, &SegmentationDecorator::enableStateChanged);
}

bool SegmentationDecorator::enableWidget() const
{
  const vtkSMPropertyHelper input(this->parentWidget()->proxy(), "Input");
  auto source = vtkSMSourceProxy::SafeDownCast(input.GetAsProxy());
  return source &&
    source->GetDataInformation(input.GetOutputPort())
      ->GetArrayInformation(SegmentationName, vtkDataObject::FIELD);
}
}

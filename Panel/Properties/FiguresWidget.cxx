// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Properties/FiguresWidget.h"

#include "Panel/Parts/InSight.h"

#include <pqApplicationCore.h>
#include <pqPipelineSource.h>
#include <pqPropertiesPanel.h>
#include <pqServerManagerModel.h>

#include <vtkPVXMLElement.h>
#include <vtkSMDocumentation.h>
#include <vtkSMDoubleVectorProperty.h>
#include <vtkSMProperty.h>
#include <vtkSMPropertyGroup.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMProxy.h>

#include <QFormLayout>
#include <QLabel>

#include <cmath>

namespace brainshift
{
namespace
{
QString unitOf(vtkSMProperty* property)
{
  vtkPVXMLElement* hints = property->GetHints();
  vtkPVXMLElement* unit = hints ? hints->FindNestedElementByName("Unit") : nullptr;
  return unit ? QString(" ") + unit->GetAttribute("name") : QString();
}

QString valueOf(vtkSMProperty* property)
{
  const vtkSMPropertyHelper helper(property);
  if (!vtkSMDoubleVectorProperty::SafeDownCast(property))
  {
    return QString::number(helper.GetAsInt());
  }
  const double value = helper.GetAsDouble();
  return std::isfinite(value) ? QString::number(value, 'f', 2) + unitOf(property) : "none";
}
}

FiguresWidget::FiguresWidget(vtkSMProxy* proxy, vtkSMPropertyGroup* group, QWidget* parent)
  : pqPropertyGroupWidget(proxy, group, parent)
{
  auto form = new QFormLayout(this);
  form->setContentsMargins(0, 0, 0, 0);
  form->setHorizontalSpacing(2 * pqPropertiesPanel::suggestedHorizontalSpacing());
  form->setVerticalSpacing(pqPropertiesPanel::suggestedVerticalSpacing());
  for (unsigned int index = 0; index < group->GetNumberOfProperties(); ++index)
  {
    this->addFigure(group, index);
  }
  new InSight(this);
  auto model = pqApplicationCore::instance()->getServerManagerModel();
  this->connect(model->findItem<pqPipelineSource*>(proxy),
    qOverload<pqPipelineSource*>(&pqPipelineSource::dataUpdated), this,
    [this] { this->showFigures(); });
  this->showFigures();
}

void FiguresWidget::addFigure(vtkSMPropertyGroup* group, unsigned int index)
{
  vtkSMProperty* property = group->GetProperty(index);
  auto figure = new QLabel(this);
  figure->setObjectName(property->GetXMLName());
  figure->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  auto form = static_cast<QFormLayout*>(this->layout());
  form->addRow(property->GetXMLLabel(), figure);
  const char* tip =
    property->GetDocumentation() ? property->GetDocumentation()->GetDescription() : nullptr;
  for (QWidget* part : { static_cast<QWidget*>(figure), form->labelForField(figure) })
  {
    part->setToolTip(QString(tip).simplified());
  }
  this->Figures.append({ property, figure });
}

void FiguresWidget::showFigures()
{
  for (const auto& [property, figure] : this->Figures)
  {
    this->proxy()->UpdatePropertyInformation(property);
    figure->setText("<b>" + valueOf(property) + "</b>");
  }
}
}

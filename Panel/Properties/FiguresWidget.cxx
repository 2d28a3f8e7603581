// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Properties/FiguresWidget.h"

#include "Panel/Parts/HistogramPlot.h"
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
#include <vector>

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

bool isHistogram(vtkSMProperty* property)
{
  vtkPVXMLElement* hints = property->GetHints();
  return hints && hints->FindNestedElementByName("Histogram");
}

QString tipOf(vtkSMProperty* property)
{
  vtkSMDocumentation* documentation = property->GetDocumentation();
  return documentation ? QString(documentation->GetDescription()).simplified() : QString();
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
    vtkSMProperty* property = group->GetProperty(index);
    if (isHistogram(property))
    {
      this->addHistogram(property);
    }
    else
    {
      this->addFigure(property);
    }
  }
  new InSight(this);
  auto model = pqApplicationCore::instance()->getServerManagerModel();
  this->connect(model->findItem<pqPipelineSource*>(proxy),
    qOverload<pqPipelineSource*>(&pqPipelineSource::dataUpdated), this,
    [this] { this->showFigures(); });
  this->showFigures();
}

void FiguresWidget::addFigure(vtkSMProperty* property)
{
  auto figure = new QLabel(this);
  figure->setObjectName(property->GetXMLName());
  figure->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  auto form = static_cast<QFormLayout*>(this->layout());
  form->addRow(property->GetXMLLabel(), figure);
  for (QWidget* part : { static_cast<QWidget*>(figure), form->labelForField(figure) })
  {
    part->setToolTip(tipOf(property));
  }
  this->Figures.append({ property, figure });
}

void FiguresWidget::addHistogram(vtkSMProperty* property)
{
  auto plot = new HistogramPlot(this);
  plot->setToolTip(tipOf(property));
  static_cast<QFormLayout*>(this->layout())->addRow(plot);
  this->Histograms.append({ property, plot });
}

void FiguresWidget::showFigures()
{
  for (const auto& [property, figure] : this->Figures)
  {
    this->proxy()->UpdatePropertyInformation(property);
    figure->setText("<b>" + valueOf(property) + "</b>");
  }
  for (const auto& [property, plot] : this->Histograms)
  {
    this->proxy()->UpdatePropertyInformation(property);
    const std::vector<double> numbers = vtkSMPropertyHelper(property).GetDoubleArray();
    const bool any = !numbers.empty();
    plot->setHistogram(any ? numbers.front() : 0.0,
      any ? QList<double>(numbers.begin() + 1, numbers.end()) : QList<double>());
  }
}
}

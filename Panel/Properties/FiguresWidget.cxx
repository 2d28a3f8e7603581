// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Properties/FiguresWidget.h"

#include "Interaction/Commands/Application.h"
#include "Interaction/Edits/StrokeEditor.h"
#include "Interaction/Views/ActiveDeformation.h"
#include "Interaction/Workarounds/Docks.h"
#include "Interaction/Workarounds/Sessions.h"
#include "Interaction/Workarounds/Updates.h"
#include "Panel/Parts/Plots.h"

#include <pqPipelineSource.h>
#include <pqPropertiesPanel.h>

#include <vtkPVXMLElement.h>
#include <vtkSMDocumentation.h>
#include <vtkSMDoubleVectorProperty.h>
#include <vtkSMProperty.h>
#include <vtkSMPropertyGroup.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMSourceProxy.h>

#include <QFormLayout>
#include <QLabel>
#include <QPushButton>

#include <algorithm>
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

bool hasHint(vtkSMProperty* property, const char* name)
{
  vtkPVXMLElement* hints = property->GetHints();
  return hints && hints->FindNestedElementByName(name);
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
    if (hasHint(property, "Histogram"))
    {
      this->addHistogram(property);
    }
    else if (hasHint(property, "Curve"))
    {
      this->addCurve(property);
    }
    else
    {
      this->addFigure(property);
    }
  }
  new InSight(this);
  this->connect(sourceOf(proxy), qOverload<pqPipelineSource*>(&pqPipelineSource::dataUpdated), this,
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

void FiguresWidget::addCurve(vtkSMProperty* property)
{
  this->Curve = property;
  this->Plot = new CurvePlot(this);
  this->Plot->setToolTip(tipOf(property));
  this->Missing = new QPushButton(tr("Measure After Each Stroke"), this);
  this->Missing->setObjectName("BrainShiftMeasureStrokes");
  this->Missing->setToolTip(
    tr("Apply the strokes one after the other. Measure after each stroke that has no point on the "
       "curve, for example a stroke from a state file. The list of strokes does not change."));
  auto form = static_cast<QFormLayout*>(this->layout());
  form->addRow(this->Plot);
  form->addRow(this->Missing);
  this->connect(this->Missing, &QPushButton::clicked, this, &FiguresWidget::measureStrokes);
}

void FiguresWidget::showCurve()
{
  pull(this->proxy(), this->Curve);
  const std::vector<double> lengths = vtkSMPropertyHelper(this->Curve).GetDoubleArray();
  this->Plot->setLengths(QList<double>(lengths.begin(), lengths.end()));
  this->Missing->setVisible(
    std::any_of(lengths.begin(), lengths.end(), [](double length) { return std::isnan(length); }));
}

void FiguresWidget::measureStrokes()
{
  StrokeEditor* editor = StrokeEditor::of(deformationUpstream(sourceOf(this->proxy())));
  auto measure = vtkSMSourceProxy::SafeDownCast(this->proxy());
  if (editor && measure)
  {
    QuietUpdates quiet; // panels need not follow each stroke
    quiet.add(measure);
    editor->walkThrough([measure] { measure->UpdatePipeline(); });
  }
  this->showFigures();
}

void FiguresWidget::showFigures()
{
  for (const auto& [property, figure] : this->Figures)
  {
    pull(this->proxy(), property);
    figure->setText("<b>" + valueOf(property) + "</b>");
  }
  for (const auto& [property, plot] : this->Histograms)
  {
    pull(this->proxy(), property);
    const std::vector<double> numbers = vtkSMPropertyHelper(property).GetDoubleArray();
    const bool any = !numbers.empty();
    plot->setHistogram(any ? numbers.front() : 0.0,
      any ? QList<double>(numbers.begin() + 1, numbers.end()) : QList<double>());
  }
  if (this->Curve)
  {
    this->showCurve();
  }
}
}

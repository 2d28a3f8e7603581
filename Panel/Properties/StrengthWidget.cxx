// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Properties/StrengthWidget.h"

#include "Interaction/Commands/Application.h"
#include "Interaction/Edits/StrokeEditor.h"
#include "Interaction/Workarounds/Docks.h"
#include "Panel/Parts/ValueSlider.h"

#include <pqPipelineSource.h>

#include <vtkCommand.h>
#include <vtkSMProperty.h>
#include <vtkSMPropertyHelper.h>

#include <QPointer>
#include <QVBoxLayout>

namespace brainshift
{
StrengthWidget::StrengthWidget(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent)
  : pqPropertyWidget(proxy, parent)
  , Slider(new ValueSlider("BrainShiftStrength", tr("Strength (0 to 1)"), 2, this))
{
  this->setProperty(property);
  this->setShowLabel(false); // the slider has one
  auto column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(this->Slider);
  this->Slider->setRange(0.0, 1.0);
  this->Slider->setToolTip(tr(
    "The fraction of the deformation that is shown. 0 shows the volume as loaded, 1 shows the full "
    "deformation. Strength can be animated."));
  auto model = serverManagerModel();
  const QPointer<StrokeEditor> editor =
    StrokeEditor::of(model->findItem<pqPipelineSource*>(proxy)); // may go before its panel does
  this->connect(this->Slider, &ValueSlider::valueEdited, this, [editor](double strength) {
    if (editor)
    {
      editor->changeStrength(strength);
    }
  });
  this->connect(this->Slider, &ValueSlider::editingFinished, this, [editor] {
    if (editor)
    {
      editor->commitStrength();
    }
  });
  this->Observers->Connect(property, vtkCommand::ModifiedEvent, this, SLOT(showStrength()));
  new InSight(this);
  this->showStrength();
}

StrengthWidget::~StrengthWidget() = default;

void StrengthWidget::showStrength()
{
  this->Slider->setValue(vtkSMPropertyHelper(this->property()).GetAsDouble());
}
}

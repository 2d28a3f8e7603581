// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Properties/PointWidget.h"

#include "Interaction/Commands/Application.h"
#include "Interaction/Edits/StrokeEditor.h"
#include "Interaction/Views/ViewProbe.h"
#include "Interaction/Workarounds/Docks.h"
#include "Panel/Parts/MillimetreField.h"

#include <pqPipelineSource.h>
#include <pqPropertiesPanel.h>

#include <vtkCommand.h>
#include <vtkSMProperty.h>

#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>

#include <cmath>
#include <limits>

namespace brainshift
{
PointWidget::PointWidget(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent)
  : pqPropertyWidget(proxy, parent)
{
  this->setProperty(property);
  this->setShowLabel(false); // the group's title says it, a label would take the room
  auto row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(pqPropertiesPanel::suggestedHorizontalSpacing());
  static const std::array<const char*, 3> axes{ "X", "Y", "Z" };
  for (std::size_t axis = 0; axis < axes.size(); ++axis)
  {
    auto field = new MillimetreField(axes[axis], std::numeric_limits<double>::lowest(), this);
    auto label = new QLabel(axes[axis], this);
    label->setBuddy(field);
    field->setAccessibleName(tr("%1, %2, millimetres").arg(property->GetXMLLabel(), axes[axis]));
    row->addWidget(label);
    row->addWidget(field, 1);
    this->Fields[axis] = field;
    this->connect(field, &MillimetreField::valueEdited, this, [this, axis](double value) {
      glm::dvec3 point = pointOfInterestOf(this->proxy());
      point[static_cast<int>(axis)] = value;
      setPointOfInterest(this->proxy(), point);
    });
  }
  auto centre = new QToolButton(this);
  centre->setObjectName("Centre");
  centre->setIcon(QIcon(":/pqWidgets/Icons/pqReset.svg"));
  centre->setToolTip(tr("Set the point to the centre of the volume. The change applies at once."));
  centre->setAccessibleName(tr("Centre of the volume"));
  row->addWidget(centre);
  this->connect(
    centre, &QToolButton::clicked, this, [this] { centrePointOfInterest(this->proxy()); });
  this->Observers->Connect(property, vtkCommand::ModifiedEvent, this, SLOT(showPoint()));
  const pqServerManagerModel* model = serverManagerModel();
  if (auto source = model->findItem<pqPipelineSource*>(proxy))
  {
    // Before, the centre of the volume may not be known.
    this->connect(source, qOverload<pqPipelineSource*>(&pqPipelineSource::dataUpdated), this,
      &PointWidget::showPoint);
  }
  new InSight(this);
  this->showPoint();
}

PointWidget::~PointWidget() = default;

void PointWidget::showPoint()
{
  const glm::dvec3 point = pointOfInterestOf(this->proxy());
  for (int axis = 0; axis < 3; ++axis)
  {
    constexpr double inMm = 1e6; // a computed centre of 0 misses it by roundings
    this->Fields[axis]->setValue(std::round(point[axis] * inMm) / inMm);
  }
}
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Properties/LengthWidget.h"

#include "Panel/Parts/MillimetreField.h"

#include <pqPropertiesPanel.h>

#include <vtkSMDoubleRangeDomain.h>
#include <vtkSMProperty.h>

#include <QHBoxLayout>

#include <limits>

namespace brainshift
{
namespace
{
double leastOf(vtkSMProperty* property)
{
  auto range = property->FindDomain<vtkSMDoubleRangeDomain>();
  int exists = 0;
  const double least = range ? range->GetMinimum(0, exists) : 0.0;
  return exists ? least : std::numeric_limits<double>::lowest();
}
}

LengthWidget::LengthWidget(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent)
  : pqPropertyWidget(proxy, parent)
  , Field(new MillimetreField("Field", leastOf(property), this))
{
  auto row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(pqPropertiesPanel::suggestedHorizontalSpacing());
  row->addWidget(this->Field, 1);
  this->Field->setAccessibleName(tr("%1, millimetres").arg(property->GetXMLLabel()));
  this->connect(this->Field, &MillimetreField::valueEdited, this, &LengthWidget::lengthChanged);
  this->addPropertyLink(this, "length", SIGNAL(lengthChanged()), property);
}

double LengthWidget::length() const
{
  return this->Field->value();
}

void LengthWidget::setLength(double length)
{
  this->Field->setValue(length);
}
}

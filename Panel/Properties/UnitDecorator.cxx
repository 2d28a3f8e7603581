// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Properties/UnitDecorator.h"

#include <pqPropertyWidget.h>

#include <vtkPVXMLElement.h>

#include <QLabel>
#include <QTimer>

namespace brainshift
{
UnitDecorator::UnitDecorator(vtkPVXMLElement* xml, pqPropertyWidget* parent)
  : pqPropertyWidgetDecorator(xml, parent)
  , Unit(QString::fromUtf8(xml->GetAttributeOrEmpty("unit")))
{
  // Later: ParaView makes the label after the widget.
  QTimer::singleShot(0, this, &UnitDecorator::addUnit);
}

void UnitDecorator::addUnit()
{
  const QWidget* field = this->parentWidget();
  QWidget* panel = field->parentWidget();
  auto label = panel
    ? panel->findChild<QLabel*>(field->objectName() + "Label", Qt::FindDirectChildrenOnly)
    : nullptr;
  if (!label)
  {
    return;
  }
  QString text = label->text(); // ParaView makes it a paragraph
  const qsizetype end = text.endsWith("</p>") ? text.size() - 4 : text.size();
  label->setText(text.insert(end, " (" + this->Unit + ")"));
}
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Properties/LabelsWidget.h"

#include <vtkPVXMLElement.h>
#include <vtkSMProperty.h>

#include <QHBoxLayout>
#include <QLineEdit>
#include <QRegularExpression>
#include <QRegularExpressionValidator>
#include <QStringList>

namespace brainshift
{
LabelsWidget::LabelsWidget(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent)
  : pqPropertyWidget(proxy, parent)
  , Line(new QLineEdit(this))
{
  this->setChangeAvailableAsChangeFinished(false);
  this->Line->setObjectName("Line");
  this->Line->setAccessibleName(property->GetXMLLabel());
  this->Line->setValidator(
    new QRegularExpressionValidator(QRegularExpression("[-0-9, ]*"), this->Line));
  vtkPVXMLElement* hints = property->GetHints();
  vtkPVXMLElement* none = hints ? hints->FindNestedElementByName("WithoutLabels") : nullptr;
  this->Line->setPlaceholderText(none ? none->GetAttribute("text") : "");
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(this->Line);
  this->connect(this->Line, &QLineEdit::textChanged, this, &LabelsWidget::labelsChanged);
  this->connect(this->Line, &QLineEdit::editingFinished, this, &LabelsWidget::changeFinished);
  this->addPropertyLink(this, "labels", SIGNAL(labelsChanged()), property);
}

QList<QVariant> LabelsWidget::labels() const
{
  QList<QVariant> labels;
  static const QRegularExpression between("[, ]+");
  for (const QString& word : this->Line->text().split(between, Qt::SkipEmptyParts))
  {
    bool isNumber = false;
    const int label = word.toInt(&isNumber);
    if (isNumber)
    {
      labels.append(label);
    }
  }
  return labels;
}

void LabelsWidget::setLabels(const QList<QVariant>& labels)
{
  if (labels == this->labels())
  {
    return; // the text stays as it was typed
  }
  QStringList words;
  for (const QVariant& label : labels)
  {
    words.append(label.toString());
  }
  this->Line->setText(words.join(' '));
}
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Parts/MillimetreField.h"

#include <QDoubleValidator>
#include <QFocusEvent>
#include <QLocale>

#include <cmath>
#include <limits>

namespace brainshift
{
namespace
{
constexpr double LeastShown = 0.05; // mm; less would be shown as 0.0

QString exactText(double value)
{
  return QString::number(value, 'g', QLocale::FloatingPointShortest);
}

QString shortText(double value)
{
  const bool small = value != 0.0 && std::abs(value) < LeastShown;
  return small ? QString::number(value, 'g', 2) : QString::number(value, 'f', 1);
}
}

MillimetreField::MillimetreField(const QString& name, double least, QWidget* parent)
  : QLineEdit(parent)
{
  this->setObjectName(name);
  auto validator = new QDoubleValidator(least, std::numeric_limits<double>::max(), -1, this);
  validator->setLocale(QLocale::c());
  this->setValidator(validator);
  this->connect(this, &QLineEdit::editingFinished, this, &MillimetreField::takeText);
  this->showValue();
}

void MillimetreField::setValue(double value)
{
  if (value != this->Value)
  {
    this->Value = value;
    this->showValue();
  }
}

QSize MillimetreField::minimumSizeHint() const
{
  const int frame = this->QLineEdit::minimumSizeHint().width() - this->fontMetrics().maxWidth();
  return { this->fontMetrics().horizontalAdvance("-1000.0") + frame,
    this->QLineEdit::minimumSizeHint().height() };
}

void MillimetreField::takeText()
{
  bool isNumber = false;
  const double typed = this->text().toDouble(&isNumber);
  if (this->text() != this->ShownText && isNumber && typed != this->Value)
  {
    this->Value = typed;
    Q_EMIT this->valueEdited(typed);
  }
  this->showValue();
}

void MillimetreField::showValue()
{
  this->ShownText = this->hasFocus() ? exactText(this->Value) : shortText(this->Value);
  this->setText(this->ShownText);
  this->setCursorPosition(0); // the first digits matter most where not all are seen
}

void MillimetreField::focusInEvent(QFocusEvent* event)
{
  this->QLineEdit::focusInEvent(event);
  this->showValue();
  if (event->reason() == Qt::TabFocusReason || event->reason() == Qt::BacktabFocusReason)
  {
    this->selectAll();
  }
}

void MillimetreField::focusOutEvent(QFocusEvent* event)
{
  this->QLineEdit::focusOutEvent(event);
  this->showValue(); // also over a text that is no number
}
}

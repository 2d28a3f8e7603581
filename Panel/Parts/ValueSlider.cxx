// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Parts/ValueSlider.h"

#include <QDoubleSpinBox>
#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QSlider>

#include <cmath>

namespace brainshift
{
namespace
{
constexpr int Steps = 1000; // of the slider: finer than its pixels
}

ValueSlider::ValueSlider(const QString& name, const QString& label, int decimals, QWidget* parent)
  : QWidget(parent)
  , Label(new QLabel(label, this))
  , Slider(new QSlider(Qt::Horizontal, this))
  , SpinBox(new QDoubleSpinBox(this))
{
  this->setObjectName(name + "Row");
  this->Slider->setObjectName(name);
  this->Slider->setAccessibleName(label);
  this->Slider->setRange(0, Steps);
  this->Slider->setMinimumWidth(40); // panels are narrow
  this->Slider->setPageStep(Steps / 10);
  this->Slider->setSingleStep(Steps / 100);
  this->SpinBox->setObjectName(name + "SpinBox");
  this->SpinBox->setDecimals(decimals);
  this->SpinBox->setSingleStep(std::pow(10.0, -decimals));
  // Wide enough for any of its kind, so that those below each other align.
  this->SpinBox->setMinimumWidth(this->fontMetrics().horizontalAdvance("000.00") + 40);
  this->SpinBox->setKeyboardTracking(false); // "12" is not 1 first
  this->Label->setBuddy(this->SpinBox);
  for (QWidget* control :
    { static_cast<QWidget*>(this->Slider), static_cast<QWidget*>(this->SpinBox) })
  {
    control->setFocusPolicy(Qt::StrongFocus);
    control->installEventFilter(this);
  }

  auto row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->addWidget(this->Label);
  row->addWidget(this->Slider, 1);
  row->addWidget(this->SpinBox);

  this->connect(this->Slider, &QSlider::valueChanged, this, [this](int step) {
    const double least = this->SpinBox->minimum();
    const QSignalBlocker quiet(this->SpinBox);
    this->SpinBox->setValue(least + (this->SpinBox->maximum() - least) * step / Steps);
    Q_EMIT this->valueEdited(this->SpinBox->value());
    if (!this->Slider->isSliderDown())
    {
      Q_EMIT this->editingFinished();
    }
  });
  this->connect(this->SpinBox, &QDoubleSpinBox::valueChanged, this, [this](double value) {
    this->moveSlider();
    Q_EMIT this->valueEdited(value);
    Q_EMIT this->editingFinished();
  });
  this->connect(this->Slider, &QSlider::sliderReleased, this, &ValueSlider::editingFinished);
}

bool ValueSlider::eventFilter(QObject* watched, QEvent* event)
{
  auto control = qobject_cast<QWidget*>(watched);
  if (event->type() == QEvent::Wheel && control && !control->hasFocus())
  {
    event->ignore();
    return true;
  }
  return this->QWidget::eventFilter(watched, event);
}

double ValueSlider::value() const
{
  return this->SpinBox->value();
}

void ValueSlider::setRange(double least, double most)
{
  const QSignalBlocker quiet(this->SpinBox);
  this->SpinBox->setRange(least, most);
  this->moveSlider();
}

void ValueSlider::setValue(double value)
{
  const QSignalBlocker quiet(this->SpinBox);
  this->SpinBox->setValue(value);
  this->moveSlider();
}

void ValueSlider::moveSlider()
{
  if (this->Slider->isSliderDown())
  {
    return; // it stays under the hand
  }
  const double least = this->SpinBox->minimum();
  const double span = this->SpinBox->maximum() - least;
  const QSignalBlocker quiet(this->Slider);
  this->Slider->setValue(
    span > 0.0 ? int(std::lround((this->SpinBox->value() - least) / span * Steps)) : 0);
}

int ValueSlider::labelWidth() const
{
  return this->Label->sizeHint().width();
}

void ValueSlider::setLabelWidth(int width)
{
  this->Label->setMinimumWidth(width);
}
}

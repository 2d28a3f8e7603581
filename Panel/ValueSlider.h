// SPDX-License-Identifier: BSD-3-Clause
// A number with a name, a slider and a spin box that tells its unit.
#ifndef BrainShift_ValueSlider_h
#define BrainShift_ValueSlider_h

#include <QWidget>

class QDoubleSpinBox;
class QLabel;
class QSlider;

class ValueSlider : public QWidget
{
  Q_OBJECT

public:
  // The slider is called `name`, the spin box `name`SpinBox, both together `name`Row.
  ValueSlider(const QString& name, const QString& label, const QString& unit, int decimals,
    QWidget* parent = nullptr);

  double value() const;

  // Without telling anyone.
  void setRange(double least, double most);
  void setValue(double value);

  // Aligns the sliders of several rows.
  int labelWidth() const;
  void setLabelWidth(int width);

Q_SIGNALS:
  void valueEdited(double value); // by the user, at each step of a drag
  void editingFinished();         // the slider was let go, or the spin box left

protected:
  // The wheel scrolls the panel unless slider or spin box was chosen first.
  bool eventFilter(QObject* watched, QEvent* event) override;

private:
  void moveSlider();

  QLabel* const Label;
  QSlider* const Slider;
  QDoubleSpinBox* const SpinBox;
};

#endif

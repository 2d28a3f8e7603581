// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A number with a name, a slider and a spin box.
#ifndef BrainShift_ValueSlider_h
#define BrainShift_ValueSlider_h

#include <QWidget>

class QDoubleSpinBox;
class QLabel;
class QSlider;

namespace brainshift
{
class ValueSlider : public QWidget
{
  Q_OBJECT

public:
  /// Object names: the slider is `name`, the spin box is `name`SpinBox, the row of both is
  /// `name`Row. The label contains the unit.
  ValueSlider(const QString& name, const QString& label, int decimals, QWidget* parent = nullptr);

  double value() const;

  /// Sets the limits and emits no signal.
  void setRange(double least, double most);
  /// Sets the number and emits no signal.
  void setValue(double value);

  /// The width that the label needs.
  int labelWidth() const;
  /// Makes the label wider, so that sliders below each other align.
  void setLabelWidth(int width);

Q_SIGNALS:
  void valueEdited(double value); ///< By the user, at each step of a drag.
  void editingFinished();         ///< The user let go of the slider or left the spin box.

protected:
  /// Passes the wheel on to the panel, unless the slider or the spin box has the focus.
  bool eventFilter(QObject* watched, QEvent* event) override;

private:
  void moveSlider();

  QLabel* const Label;
  QSlider* const Slider;
  QDoubleSpinBox* const SpinBox;
};
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A field for a number in mm. It shows one decimal, which a narrow panel has room for, and all
/// decimals while it has the keyboard's focus. Digits that the user does not change remain exact.
#ifndef BrainShift_MillimetreField_h
#define BrainShift_MillimetreField_h

#include <QLineEdit>

namespace brainshift
{
class MillimetreField : public QLineEdit
{
  Q_OBJECT

public:
  /// `least`: the smallest number (mm) that can be typed.
  MillimetreField(const QString& name, double least, QWidget* parent = nullptr);

  /// mm, exact; default 0.
  double value() const { return this->Value; }
  /// Sets the number and emits no signal.
  void setValue(double value);

  /// Wide enough for "-1000.0".
  QSize minimumSizeHint() const override;
  QSize sizeHint() const override { return this->minimumSizeHint(); }

Q_SIGNALS:
  void valueEdited(double value); ///< The user typed another number and left the field.

protected:
  void focusInEvent(QFocusEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;

private:
  void takeText();
  void showValue();

  double Value = 0.0;
  QString ShownText; ///< As the user found it.
};
}

#endif

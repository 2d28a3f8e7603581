// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Panel of one length in mm, which waits for Apply. It is for double properties with panel_widget
/// "BrainShiftLength".
#ifndef BrainShift_LengthWidget_h
#define BrainShift_LengthWidget_h

#include <pqPropertyWidget.h>

namespace brainshift
{
class MillimetreField;

class LengthWidget : public pqPropertyWidget
{
  Q_OBJECT
  Q_PROPERTY(double length READ length WRITE setLength NOTIFY lengthChanged)

public:
  LengthWidget(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent = nullptr);

  double length() const;
  void setLength(double length);

Q_SIGNALS:
  void lengthChanged();

private:
  MillimetreField* const Field;
};
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Slider of the fraction of the deformation that is shown. It acts at once. It is for a property
/// with panel_widget "BrainShiftStrength".
#ifndef BrainShift_StrengthWidget_h
#define BrainShift_StrengthWidget_h

#include <pqPropertyWidget.h>

#include <vtkNew.h>

class vtkEventQtSlotConnect;

namespace brainshift
{
class ValueSlider;

class StrengthWidget : public pqPropertyWidget
{
  Q_OBJECT

public:
  StrengthWidget(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent = nullptr);
  ~StrengthWidget() override;

private Q_SLOTS:
  void showStrength();

private:
  ValueSlider* const Slider;
  vtkNew<vtkEventQtSlotConnect> Observers;
};
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Panel of the point of interest: X, Y and Z in mm, and a button for the centre of the volume. It
/// acts at once, without Apply, and each change is one undo step. The key I does the same in a
/// view. It is for the property PointOfInterest with panel_widget "BrainShiftPoint".
#ifndef BrainShift_PointWidget_h
#define BrainShift_PointWidget_h

#include <pqPropertyWidget.h>

#include <vtkNew.h>

#include <array>

class vtkEventQtSlotConnect;

namespace brainshift
{
class MillimetreField;

class PointWidget : public pqPropertyWidget
{
  Q_OBJECT

public:
  PointWidget(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent = nullptr);
  ~PointWidget() override;

private Q_SLOTS:
  void showPoint();

private:
  std::array<MillimetreField*, 3> Fields{};
  vtkNew<vtkEventQtSlotConnect> Observers;
};
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Panel of a point in mm: X, Y and Z, and a button for the centre of the volume. It acts at once,
/// without Apply, and each change is one undo step. It is for double properties of three elements
/// with panel_widget "BrainShiftPoint".
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
  using Point = std::array<double, 3>; ///< x, y, z; mm.

  void write(const Point& point);
  void takeCentre();

  std::array<MillimetreField*, 3> Fields{};
  vtkNew<vtkEventQtSlotConnect> Observers;
};
}

#endif

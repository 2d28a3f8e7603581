// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Aligns the reference of a Compare Volumes; it acts at once, without Apply. It is for properties
/// with panel_widget "BrainShiftAlign".
#ifndef BrainShift_AlignWidget_h
#define BrainShift_AlignWidget_h

#include <pqPropertyWidget.h>

namespace brainshift
{
class AlignWidget : public pqPropertyWidget
{
  Q_OBJECT

public:
  AlignWidget(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent = nullptr);
};
}

#endif

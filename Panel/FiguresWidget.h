// SPDX-License-Identifier: BSD-3-Clause
// Panel of what a filter reports: each property's label, its value and its unit, as fresh as the
// filter's data. For property groups with panel_widget "BrainShiftFigures", of which a property may
// have the hint <Unit name="mm" />.
#ifndef BrainShift_FiguresWidget_h
#define BrainShift_FiguresWidget_h

#include <pqPropertyGroupWidget.h>

#include <QList>
#include <QPair>

class QLabel;
class vtkSMProperty;

class FiguresWidget : public pqPropertyGroupWidget
{
  Q_OBJECT

public:
  FiguresWidget(vtkSMProxy* proxy, vtkSMPropertyGroup* group, QWidget* parent = nullptr);

private:
  void addFigure(vtkSMPropertyGroup* group, unsigned int index);
  void showFigures();

  QList<QPair<vtkSMProperty*, QLabel*>> Figures;
};

#endif

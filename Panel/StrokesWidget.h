// SPDX-License-Identifier: BSD-3-Clause
// Panel of the property Strokes: the tools that make strokes and the list of those made. Both act
// at once, without Apply. For properties with panel_widget "BrainShiftStrokes".
#ifndef BrainShift_StrokesWidget_h
#define BrainShift_StrokesWidget_h

#include "LatticeProbe.h"

#include <pqPropertyWidget.h>

#include <QTimer>

#include <optional>

class pqPipelineSource;
class StrokeModel;
class ToolPanel;

class StrokesWidget : public pqPropertyWidget
{
  Q_OBJECT

public:
  StrokesWidget(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent = nullptr);

private:
  void followStrokes();    // under the hand, as often as can be read
  void followResult();     // of the filter's last execution
  double latticeSpacing(); // the widest between two control points, mm; 0 before there is one

  pqPipelineSource* const Source;
  ToolPanel* const Tools;
  StrokeModel* const Strokes;
  QTimer ListSoon;
  std::optional<LatticeProbe> Lattice; // once there is something to ask
};

#endif

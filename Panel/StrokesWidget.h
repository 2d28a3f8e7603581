// SPDX-License-Identifier: BSD-3-Clause
// Panel of the property Strokes: the tools that make strokes and the list of those made. Both act
// at once, without Apply. For properties with panel_widget "BrainShiftStrokes".
#ifndef BrainShift_StrokesWidget_h
#define BrainShift_StrokesWidget_h

#include <pqPropertyWidget.h>

class pqPipelineSource;
class StrokeModel;
class ToolPanel;

class StrokesWidget : public pqPropertyWidget
{
  Q_OBJECT

public:
  StrokesWidget(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent = nullptr);

private:
  void followResult(); // of the filter's last execution

  pqPipelineSource* const Source;
  ToolPanel* const Tools;
  StrokeModel* const Strokes;
};

#endif

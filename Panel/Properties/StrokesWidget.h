// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Panel of the property Strokes: the tools and the list of strokes. Both act at once, without
/// Apply. It is for properties with panel_widget "BrainShiftStrokes".
#ifndef BrainShift_StrokesWidget_h
#define BrainShift_StrokesWidget_h

#include "Interaction/Views/ViewProbe.h"

#include <pqPropertyWidget.h>

#include <QTimer>

class pqPipelineSource;

namespace brainshift
{
class StrokeModel;
class ToolPanel;

class StrokesWidget : public pqPropertyWidget
{
  Q_OBJECT

public:
  StrokesWidget(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent = nullptr);

private:
  void followStrokes();    ///< During a drag, a few times a second.
  void followResult();     ///< After the filter executed.
  double latticeSpacing(); ///< Largest of the three, mm. 0 before the filter was applied.

  pqPipelineSource* const Source;
  ToolPanel* const Tools;
  StrokeModel* const Strokes;
  QTimer ListSoon;
  std::optional<LatticeProbe> Lattice; ///< Set once the filter was applied.
};
}

#endif

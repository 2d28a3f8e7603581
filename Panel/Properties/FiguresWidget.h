// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Panel of the figures that a filter reports: label, value and unit of each property. It follows
/// the data of the filter. It is for property groups with panel_widget "BrainShiftFigures". A
/// property may have the hint <Unit name="mm" />. A property with the hint <Histogram /> holds the
/// width of the bins of a histogram, then their counts, and is drawn below the others. One with the
/// hint <Curve /> holds a length (mm) after none, one, ... all strokes and is drawn as a curve.
#ifndef BrainShift_FiguresWidget_h
#define BrainShift_FiguresWidget_h

#include <pqPropertyGroupWidget.h>

#include <QList>
#include <QPair>

class QLabel;
class QPushButton;
class vtkSMProperty;

namespace brainshift
{
class CurvePlot;
class HistogramPlot;

class FiguresWidget : public pqPropertyGroupWidget
{
  Q_OBJECT

public:
  FiguresWidget(vtkSMProxy* proxy, vtkSMPropertyGroup* group, QWidget* parent = nullptr);

private:
  void addFigure(vtkSMProperty* property);
  void addHistogram(vtkSMProperty* property);
  void addCurve(vtkSMProperty* property);
  void showFigures();
  void showCurve();
  void measureStrokes();

  QList<QPair<vtkSMProperty*, QLabel*>> Figures;
  QList<QPair<vtkSMProperty*, HistogramPlot*>> Histograms;
  vtkSMProperty* Curve = nullptr; ///< null: this filter has none
  CurvePlot* Plot = nullptr;
  QPushButton* Missing = nullptr; ///< measures what the curve lacks
};
}

#endif

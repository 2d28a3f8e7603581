// SPDX-License-Identifier: BSD-3-Clause
// Panel of what comes of the strokes: Strength, live, and how far and how hard tissue is bent. For
// property groups with panel_widget "BrainShiftResult".
#ifndef BrainShift_ResultWidget_h
#define BrainShift_ResultWidget_h

#include <pqPropertyGroupWidget.h>

#include <vtkNew.h>

#include <QElapsedTimer>
#include <QTimer>

class pqPipelineSource;
class QCheckBox;
class QFormLayout;
class QLabel;
class QVBoxLayout;
class ValueSlider;
class vtkEventQtSlotConnect;

class ResultWidget : public pqPropertyGroupWidget
{
  Q_OBJECT

public:
  ResultWidget(vtkSMProxy* proxy, vtkSMPropertyGroup* group, QWidget* parent = nullptr);
  ~ResultWidget() override;

protected:
  void changeEvent(QEvent* event) override; // colours follow the theme
  void showEvent(QShowEvent* event) override;

private Q_SLOTS:
  void showStrength();
  void showGuard();
  void showFigures();

private:
  QLabel* addFigure(QFormLayout* form, const char* name, const QString& title, const QString& tip);
  void connectStrength();
  void addGuard(QVBoxLayout* column);
  void setGuard(bool on);
  void showFiguresSoon();
  double figure(const char* property);

  pqPipelineSource* const Source;
  ValueSlider* const Strength;
  QLabel* Displacement = nullptr;
  QLabel* Jacobian = nullptr;
  QCheckBox* Guard = nullptr; // none where the filter has no guard
  QLabel* Shortened = nullptr;
  QTimer FiguresSoon; // merges the updates of a drag: the smallest determinant takes its time
  QElapsedTimer SinceFigures;
  vtkNew<vtkEventQtSlotConnect> Observers;
};

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Panel of the result of all strokes: the largest displacement, the smallest Jacobian determinant,
/// and the guard against folding. It acts at once. It is for property groups with panel_widget
/// "BrainShiftResult".
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
class vtkEventQtSlotConnect;

namespace brainshift
{
class ResultWidget : public pqPropertyGroupWidget
{
  Q_OBJECT

public:
  ResultWidget(vtkSMProxy* proxy, vtkSMPropertyGroup* group, QWidget* parent = nullptr);
  ~ResultWidget() override;

protected:
  void changeEvent(QEvent* event) override; ///< Colours follow the theme.
  void showEvent(QShowEvent* event) override;

private Q_SLOTS:
  void showGuard();
  void showFigures();

private:
  QLabel* addFigure(QFormLayout* form, const char* name, const QString& title, const QString& tip);
  void addGuard(QVBoxLayout* column);
  void setGuard(bool on);
  void showFiguresSoon();
  double figure(const char* property) const;

  pqPipelineSource* const Source;
  QLabel* Displacement = nullptr;
  QLabel* Jacobian = nullptr;
  QCheckBox* Guard = nullptr; ///< Null where the filter has no guard.
  QLabel* Shortened = nullptr;
  QTimer
    FiguresSoon; ///< Merges the updates of a drag: the smallest determinant is slow to compute.
  QElapsedTimer SinceFigures;
  qint64 FiguresTookMs = 0; ///< The last time, until the server had answered all.
  vtkNew<vtkEventQtSlotConnect> Observers;
};
}

#endif

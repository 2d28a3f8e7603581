// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The section "Refine" of the panel of a Free-Form Deformation, closed at first: reference,
/// similarity, buttons, progress and result.
#ifndef BrainShift_RefinePane_h
#define BrainShift_RefinePane_h

#include <QPointer>
#include <QTimer>
#include <QWidget>

class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QProgressBar;
class QToolButton;
class QVBoxLayout;
class pqPipelineSource;

namespace brainshift
{
class CostPlot;
class LandmarkErrors;
class RefineEditor;
struct RefineFigures;

/// How far a refinement is that runs, in a sentence.
QString refineProgress(const RefineFigures& figures);

class RefinePane : public QWidget
{
  Q_OBJECT

public:
  RefinePane(pqPipelineSource* deformation, QWidget* parent = nullptr);

protected:
  void resizeEvent(QResizeEvent* event) override;

private:
  void addChoices(QVBoxLayout* column);
  void addButtons(QVBoxLayout* column);
  void addProgress(QVBoxLayout* column);
  void followApplication();
  void open(bool on);
  void listSources();
  void refine();
  void refresh();
  void showCavityOf(pqPipelineSource* reference);
  void report();
  void bringIntoSight();
  pqPipelineSource* chosen(const QComboBox* list) const; ///< Null: none.

  const QPointer<pqPipelineSource> Deformation; ///< It may go before its panel does.
  const QPointer<RefineEditor> Editor;
  const QPointer<LandmarkErrors> OfLandmarks;
  QToolButton* const Opener;
  QWidget* const Body;
  QComboBox* Reference = nullptr;
  QComboBox* Cavity = nullptr;
  QComboBox* Similarity = nullptr;
  QDoubleSpinBox* Stiffness = nullptr;
  QVariant ChosenCavity; ///< While a Compare Volumes has its own: the user's, if any.
  QWidget* Choices = nullptr;
  QWidget* CavityRow = nullptr;
  QToolButton* Refine = nullptr;
  QToolButton* Pause = nullptr;
  QToolButton* Stop = nullptr;
  QProgressBar* Progress = nullptr;
  CostPlot* Plot = nullptr;
  QLabel* Report = nullptr;
  QLabel* Warning = nullptr;
  QLabel* Errors = nullptr;
  QToolButton* Keep = nullptr;
  QTimer Soon; ///< Merges the events that change the lists.
};
}

#endif

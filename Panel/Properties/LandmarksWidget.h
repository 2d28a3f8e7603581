// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Panel of the landmarks of a Fit Deformation: the table of the Free-Form Deformation that takes
/// the fit as its Lattice. It is for properties with panel_widget "BrainShiftLandmarks".
#ifndef BrainShift_LandmarksWidget_h
#define BrainShift_LandmarksWidget_h

#include <pqPropertyWidget.h>

#include <QPointer>

class QLabel;
class QVBoxLayout;
class pqPipelineSource;

namespace brainshift
{
class LandmarksWidget : public pqPropertyWidget
{
  Q_OBJECT

public:
  LandmarksWidget(vtkSMProxy* proxy, vtkSMProperty* property, QWidget* parent = nullptr);

private:
  pqPipelineSource* taker() const; ///< Null: no Free-Form Deformation takes the fit.
  void refresh();

  QVBoxLayout* const Column;
  QLabel* const Nobody;
  QPointer<QWidget> Table;
  QPointer<pqPipelineSource> Shown;
};
}

#endif

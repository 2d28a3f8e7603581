// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Writes into each view that shows a comparison which volume has which colour, by the names of the
/// pipeline browser.
#ifndef BrainShift_ComparisonLegend_h
#define BrainShift_ComparisonLegend_h

#include <vtkEventQtSlotConnect.h>
#include <vtkNew.h>

#include <QObject>

class pqDataRepresentation;
class pqPipelineSource;

namespace brainshift
{
class ComparisonLegend : public QObject
{
  Q_OBJECT

public:
  explicit ComparisonLegend(QObject* parent);

private Q_SLOTS:
  void refresh();

private:
  void watch(pqPipelineSource* source);
  void follow(pqDataRepresentation* display);

  vtkNew<vtkEventQtSlotConnect> Connector;
};
}

#endif

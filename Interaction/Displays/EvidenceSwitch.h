// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Switches a fit's Evidence on when a display is told to show it, so that a user needs one click.
#ifndef BrainShift_EvidenceSwitch_h
#define BrainShift_EvidenceSwitch_h

#include <vtkEventQtSlotConnect.h>
#include <vtkNew.h>

#include <QObject>

class pqRepresentation;
class vtkObject;

namespace brainshift
{
class EvidenceSwitch : public QObject
{
  Q_OBJECT

public:
  explicit EvidenceSwitch(QObject* parent);

private Q_SLOTS:
  /// Of a display's ShowEvidence.
  void follow(vtkObject* property);

private:
  void watch(pqRepresentation* display);

  vtkNew<vtkEventQtSlotConnect> Connector;
};
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Switches a fit's Evidence (uncertainty, mm) on when a display begins to show it, so that a user
/// needs one click.
#ifndef BrainShift_EvidenceSwitch_h
#define BrainShift_EvidenceSwitch_h

#include <vtkEventQtSlotConnect.h>
#include <vtkNew.h>

#include <QObject>
#include <QSet>

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
  /// Of a display that takes over its properties: then ParaView records a step of undo.
  void follow(vtkObject* display);

  /// Of a display's ShowEvidence that no signal has announced yet.
  void note(vtkObject* property, unsigned long event, void* display);

private:
  void watch(pqRepresentation* display);

  vtkNew<vtkEventQtSlotConnect> Connector;
  QSet<void*> Changed; // displays
};
}

#endif

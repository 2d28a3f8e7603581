// SPDX-License-Identifier: BSD-3-Clause
// What BrainShift does in ParaView's window on its own accord. It sets properties that are there,
// and computes nothing.
#ifndef BrainShift_BrainShiftBehavior_h
#define BrainShift_BrainShiftBehavior_h

#include <QObject>

class ViewTools;
class pqRepresentation;
class vtkSMProxy;

class BrainShiftBehavior : public QObject
{
  Q_OBJECT

public:
  BrainShiftBehavior(QObject* parent = nullptr);

  void onStartup();
  void onShutdown();

private:
  // Makes a representation that becomes Deformed Volume drawable: it colours by an array, as
  // ParaView takes care of for Volume only, and, the first time, shades.
  void watchRepresentation(pqRepresentation* representation);

  ViewTools* Hand = nullptr; // the tools in the view, while the plugin is at work
};

#endif

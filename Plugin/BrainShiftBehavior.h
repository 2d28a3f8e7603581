// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Everything that BrainShift does in ParaView's window by itself. It sets existing properties and
/// computes nothing.
#ifndef BrainShift_BrainShiftBehavior_h
#define BrainShift_BrainShiftBehavior_h

#include <QObject>

class pqPipelineSource;
class pqRepresentation;
class vtkSMProxy;

namespace brainshift
{
class ToolCarrier;
}

class BrainShiftBehavior : public QObject
{
  Q_OBJECT

public:
  BrainShiftBehavior(QObject* parent = nullptr);

  /// ParaView calls it after the plugin was loaded.
  void onStartup();
  /// ParaView calls it before it ends.
  void onShutdown();

private:
  /// Prepares a representation that becomes Deformed Volume or Deformed Slices: it gets an array to
  /// colour by, which ParaView chooses for Volume only. A volume is also shaded the first time.
  void watchRepresentation(pqRepresentation* representation);

  /// Keeps the numbers that a filter reports in the panel up to date.
  void watchSource(pqPipelineSource* source);

  brainshift::ToolCarrier* Hand = nullptr; ///< From startup to shutdown.
};

#endif

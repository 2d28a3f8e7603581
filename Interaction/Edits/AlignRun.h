// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// An alignment beside the data, which may lie on a server: one searched line for each call, and
/// what is known after it. It changes nothing in the pipeline.
#ifndef BrainShift_AlignRun_h
#define BrainShift_AlignRun_h

#include "Filters/Attached/ReferenceVolume.h"

#include <vtkSMProxy.h>
#include <vtkSmartPointer.h>

#include <QString>

class pqPipelineSource;

namespace brainshift
{
/// What is known after a line was searched.
struct AlignFigures
{
  int lines = 0;                  ///< searched so far
  double done = 0.0;              ///< share of the most rounds there may be, 0 to 1
  double compared = 0.0;          ///< share of the volume within the reference, 0 to 1
  double information = 0.0;       ///< mutual information on this level, nats; more is better
  double informationBefore = 0.0; ///< of the reference where it was, on the same level
  double shift = 0.0;             ///< of the middle of what is compared, mm
  double turn = 0.0;              ///< degrees
};

/// How the reference of a Compare Volumes is moved, as its properties say.
RigidMotion motionOf(vtkSMProxy* compare);

class AlignRun
{
public:
  /// Reads both volumes and begins from where the reference lies. Returns why it cannot: a
  /// sentence; empty if it can.
  QString begin(pqPipelineSource* compare);
  /// Searches one line. False if that failed or the server is gone.
  bool step();
  /// Lets go of the volumes. Figures stay.
  void end() { this->Proxy = nullptr; }

  /// How the reference was moved at the beginning.
  const RigidMotion& start() const { return this->Start; }
  /// How it must be moved to lie where the search has come to, rounded for the panel.
  RigidMotion motion() const;
  const AlignFigures& figures() const { return this->Figures; }

private:
  vtkSmartPointer<vtkSMProxy> Proxy;
  RigidMotion Start;
  AlignFigures Figures;
};
}

#endif

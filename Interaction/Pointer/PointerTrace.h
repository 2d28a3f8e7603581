// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Records where the tip goes as the traced points of a Fit Deformation, so that the brain deforms
/// while the hand moves. All of it is one undo step.
#ifndef BrainShift_PointerTrace_h
#define BrainShift_PointerTrace_h

#include <vtkSmartPointer.h>

#include <QPointer>
#include <QString>

#include <glm/glm.hpp>

#include <vector>

class pqPipelineSource;
class vtkSMProxy;

namespace brainshift
{
class PointerTrace
{
public:
  /// Begins a trace that goes on from the points that were recorded before. Returns one sentence if
  /// the deformation can have none. `threshold`: the intensity of the cortex for a new fit, if no
  /// other is set.
  QString begin(pqPipelineSource* deformation, double threshold);
  /// Adds a point (mm, world) if it is at least 0.5 mm from the last one.
  void add(const glm::dvec3& tip);
  /// Fits the deformation to the points so far.
  void fit();
  /// Ends the trace. Without a point nothing changes.
  void end();

  /// Ends the trace and changes nothing: its deformation goes.
  void abandon();

  /// The deformation that the trace edits; null if it is gone.
  pqPipelineSource* deformation() const;
  bool isRecording() const { return this->Recording; }
  /// All points, three numbers each, those of before included.
  const std::vector<double>& points() const { return this->Points; }
  int added() const;

private:
  vtkSmartPointer<vtkSMProxy> traces() const; // the point source; null if there is none
  void write(const QString& label, vtkSMProxy* forNow = nullptr);
  void restore();

  QPointer<pqPipelineSource> Deformation;
  std::vector<double> Before;
  std::vector<double> Points;
  std::size_t Bent = 0; // how many numbers the brain is bent by
  double Threshold = 0.5;
  bool Recording = false;
  bool HadFit = false;
  bool HadTraces = false;
};
}

#endif

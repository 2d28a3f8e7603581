// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Distance of the tip to the deformed cortex. A Trace Distance of its own, which is in no
/// pipeline, computes it in the process that has the volume, on the server too. The cortex is that
/// of a Trace Distance of the same deformation, else that of its fit, else a threshold.
#ifndef BrainShift_TipDistance_h
#define BrainShift_TipDistance_h

#include <vtkSmartPointer.h>

#include <QPointer>
#include <QString>

#include <glm/glm.hpp>

#include <limits>
#include <optional>

class pqPipelineSource;
class vtkSMProxy;
class vtkSMSourceProxy;

namespace brainshift
{
/// The filter that defines the cortex of a deformation: a Trace Distance or a Fit
/// Deformation. Null if there is none.
vtkSMProxy* cortexOf(pqPipelineSource* deformation);

/// The cortex of a new filter: that of `from`, or, if it is null, the threshold.
void setCortex(vtkSMProxy* filter, vtkSMProxy* from, double threshold);

/// Halfway between the smallest and the largest value of the array that a deformation shows first.
/// 0.5 if it has none.
double halfwayThreshold(pqPipelineSource* deformation);

class TipDistance
{
public:
  /// The signed distance (mm, positive outside) of a point (mm, world). None, and a problem() in
  /// one sentence, if there is no cortex; none without a problem in a cavity.
  std::optional<double> of(pqPipelineSource* deformation, const glm::dvec3& tip, double threshold);
  const QString& problem() const { return this->Problem; }

  /// Lets go of the volume.
  void forget();

private:
  void make(pqPipelineSource* deformation);
  bool hasSurface(vtkSMProxy* from, double threshold);

  QPointer<pqPipelineSource> Deformation;
  vtkSmartPointer<vtkSMProxy> Point;
  vtkSmartPointer<vtkSMSourceProxy> Filter;
  QString Problem;
};
}

#endif

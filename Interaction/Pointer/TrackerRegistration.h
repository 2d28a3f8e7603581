// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The rigid transform from the tracker to the image: the rotation and translation that minimise
/// the root mean square distance of paired points (Arun, Huang, Blostein: Least-squares fitting of
/// two 3-D point sets, IEEE PAMI 9, 1987). RigidPose.h solves it.
#ifndef BrainShift_TrackerRegistration_h
#define BrainShift_TrackerRegistration_h

#include "Filters/Fit/RigidPose.h"

#include <QString>

#include <optional>

namespace brainshift
{
class TrackerRegistration
{
public:
  /// A landmark, touched with the tip (mm, tracker's frame) and marked in the image (mm, world).
  struct Pair
  {
    glm::dvec3 tracker{ 0.0 };
    std::optional<glm::dvec3> image;
    double residual = 0.0; ///< Fiducial registration error, mm. NaN: not solved.
  };

  const std::vector<Pair>& pairs() const { return this->Pairs; }
  void touch(const glm::dvec3& tracker);
  void mark(int row, const glm::dvec3& image);
  void remove(int row);

  /// Takes a pose that was solved before, for example with a recorded session. It has no pairs.
  void take(const RigidPose& imageFromTracker);

  /// The identity as long as there is none.
  const RigidPose& imageFromTracker() const { return this->Solved; }
  bool isRegistered() const { return this->Registered; }
  /// Root mean square of the fiducial registration errors (mm); NaN if nothing was solved.
  double error() const { return this->Error; }
  /// Why the pairs give no pose, in one sentence. Empty if they do, and without pairs.
  const QString& problem() const { return this->Problem; }
  /// What to check about the pose that the pairs give, in one sentence. Empty if there is nothing.
  const QString& doubt() const { return this->Doubt; }

private:
  void solve();

  std::vector<Pair> Pairs;
  RigidPose Solved;
  bool Registered = false;
  double Error = 0.0;
  QString Problem;
  QString Doubt;
};
}

#endif

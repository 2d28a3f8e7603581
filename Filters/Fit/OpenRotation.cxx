// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Fit/OpenRotation.h"

#include "Filters/Fit/RigidPose.h"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace brainshift
{
namespace
{
// A point at the distance 1 from an axis is moved by the root of 2 by any rotation about it.
const double AnyRotation = std::sqrt(2.0);
}

double OpenRotation::distance(const glm::dvec3& rest) const
{
  const glm::dvec3 away = rest - this->centre;
  double squares = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double along = glm::dot(away, this->axes[axis]);
    const double square = glm::dot(away, away) - along * along;
    squares += this->deviations[axis] * this->deviations[axis] * std::max(0.0, square);
  }
  return std::min(std::sqrt(squares), AnyRotation * glm::length(away));
}

OpenRotation openRotationOf(const std::vector<glm::dvec3>& points,
  const std::vector<double>& weights, double deviationMm, double expected)
{
  OpenRotation open;
  open.centre = weightedMean(points, weights);
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const glm::dvec3 away = points[i] - open.centre;
    const Eigen::Vector3d from(away.x, away.y, away.z);
    sum += weights[i] * from * from.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(sum);
  const Eigen::Vector3d squares = solver.eigenvalues().cwiseMax(0.0); // the largest one is last
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto column = solver.eigenvectors().col(2 - axis);
    open.axes[axis] = { column[0], column[1], column[2] };
    const double arms = std::sqrt(squares.sum() - squares[2 - axis]);
    const double deviation = arms > 0.0 ? deviationMm / arms : AnyRotation;
    open.deviations[axis] = deviation > expected ? std::min(deviation, AnyRotation) : 0.0;
  }
  return open;
}
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Fit/RigidPose.h"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace brainshift
{
namespace
{
constexpr double Flat = 1e-9; // fraction of the largest spread below which there is none

Eigen::Vector3d eigenFrom(const glm::dvec3& v)
{
  return { v.x, v.y, v.z };
}

Eigen::Matrix3d eigenFrom(const glm::dmat3& m)
{
  Eigen::Matrix3d result;
  result << m[0][0], m[1][0], m[2][0], m[0][1], m[1][1], m[2][1], m[0][2], m[1][2], m[2][2];
  return result;
}

glm::dmat3 glmFrom(const Eigen::Matrix3d& m)
{
  return { m(0, 0), m(1, 0), m(2, 0), m(0, 1), m(1, 1), m(2, 1), m(0, 2), m(1, 2), m(2, 2) };
}

// Sum of weight times (from - mean) (to - mean)^T.
Eigen::Matrix3d products(const std::vector<glm::dvec3>& from, const std::vector<glm::dvec3>& to,
  const std::vector<double>& weights)
{
  const glm::dvec3 fromMean = weightedMean(from, weights);
  const glm::dvec3 toMean = weightedMean(to, weights);
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < from.size(); ++i)
  {
    sum += weights[i] * eigenFrom(from[i] - fromMean) * eigenFrom(to[i] - toMean).transpose();
  }
  return sum;
}
}

RigidPose turnedAround(
  const glm::dvec3& centre, const glm::dmat3& rotation, const glm::dvec3& shift)
{
  return { rotation, centre + shift - rotation * centre };
}

glm::dmat3 rotationFrom(const glm::dvec3& vector)
{
  const double angle = glm::length(vector);
  if (angle == 0.0)
  {
    return glm::dmat3(1.0);
  }
  const Eigen::Vector3d axis = eigenFrom(vector / angle);
  return glmFrom(Eigen::AngleAxisd(angle, axis).toRotationMatrix());
}

glm::dvec3 vectorFrom(const glm::dmat3& rotation)
{
  const Eigen::AngleAxisd turn(eigenFrom(rotation));
  const Eigen::Vector3d vector = turn.angle() * turn.axis();
  return { vector[0], vector[1], vector[2] };
}

glm::dvec3 weightedMean(const std::vector<glm::dvec3>& points, const std::vector<double>& weights)
{
  const double all = std::accumulate(weights.begin(), weights.end(), 0.0);
  glm::dvec3 sum(0.0);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    sum += weights[i] * points[i];
  }
  return all > 0.0 ? sum / all : glm::dvec3(0.0);
}

glm::dmat3 nearestRotation(const std::vector<glm::dvec3>& from, const std::vector<glm::dvec3>& to,
  const std::vector<double>& weights)
{
  const Eigen::JacobiSVD<Eigen::Matrix3d> parts(
    products(from, to, weights), Eigen::ComputeFullU | Eigen::ComputeFullV);
  const auto& sizes = parts.singularValues();
  if (sizes[1] <= Flat * sizes[0])
  {
    return glm::dmat3(1.0);
  }
  const Eigen::Matrix3d mirrored = parts.matrixV() * parts.matrixU().transpose();
  const Eigen::Vector3d signs(1.0, 1.0, mirrored.determinant() < 0.0 ? -1.0 : 1.0);
  return glmFrom(parts.matrixV() * signs.asDiagonal() * parts.matrixU().transpose());
}

double spreadAroundLine(const std::vector<glm::dvec3>& points, const std::vector<double>& weights)
{
  const double all = std::accumulate(weights.begin(), weights.end(), 0.0);
  if (all <= 0.0)
  {
    return 0.0;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(
    products(points, points, weights) / all, Eigen::EigenvaluesOnly);
  const auto& squares = axes.eigenvalues(); // the largest one is along the line
  return std::sqrt(std::max(0.0, squares[0]) + std::max(0.0, squares[1]));
}
}

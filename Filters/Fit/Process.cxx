// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Fit/Process.h"

#include "Common/Parallel.h"
#include "Common/Problem.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

namespace brainshift
{
namespace
{
constexpr std::int64_t ColumnsAtLeast = 48; // for a thread: about 0.1 ms
constexpr std::int64_t PointsAtLeast = 64;
constexpr std::int64_t PointsTogether = 64; // as columns of one matrix, which the cache holds

// Rows of a rigid mean: displacement of a point by a unit of each of its six numbers.
Eigen::Matrix<double, 3, 6> meanAt(const glm::dvec3& fromCentre)
{
  const glm::dvec3& p = fromCentre;
  Eigen::Matrix<double, 3, 6> basis;
  basis << 1, 0, 0, 0, p.z, -p.y, //
    0, 1, 0, -p.z, 0, p.x,        //
    0, 0, 1, p.y, -p.x, 0;
  return basis;
}

// What explains variance at any position, for rows at shared centres: with the covariances k of a
// position with the centres, the trace of what the rows explain is |factor^T k|^2.
struct Explained
{
  Eigen::MatrixXd factor; // lower triangle
  Eigen::MatrixXd away;   // of a mean: 18 numbers for each centre, see meanAt
};

glm::dmat3 glmFrom(const Eigen::Matrix3d& m)
{
  return { m(0, 0), m(1, 0), m(2, 0), m(0, 1), m(1, 1), m(2, 1), m(0, 2), m(1, 2), m(2, 2) };
}
}

struct Process::State
{
  Matern Kernel;
  std::vector<Row> Rows;
  int Factors = 0;

  // Where rows measure. Rows at one point share it.
  std::vector<int> CentreOf;
  Eigen::ArrayXd X, Y, Z;

  Eigen::MatrixXd Lower;   // Cholesky factor of the rows' covariance
  Eigen::VectorXd Weights; // of the rows
  Eigen::ArrayX3d Pulls;   // of the centres: sums of axis times weight
  std::optional<RigidMean> Mean;
  Eigen::MatrixXd Basis;                          // of the mean, at the rows
  Eigen::MatrixXd Solved;                         // inverse of the covariance times Basis
  Eigen::LLT<Eigen::Matrix<double, 6, 6>> Motion; // precision of the mean after the rows

  void placeCentres()
  {
    std::map<std::tuple<double, double, double>, int> known;
    std::vector<glm::dvec3> centres;
    this->CentreOf.clear();
    for (const Row& row : this->Rows)
    {
      const auto [at, isNew] = known.try_emplace(
        { row.point.x, row.point.y, row.point.z }, static_cast<int>(centres.size()));
      if (isNew)
      {
        centres.push_back(row.point);
      }
      this->CentreOf.push_back(at->second);
    }
    const auto count = static_cast<Eigen::Index>(centres.size());
    this->X.resize(count);
    this->Y.resize(count);
    this->Z.resize(count);
    for (Eigen::Index i = 0; i < count; ++i)
    {
      this->X[i] = centres[i].x;
      this->Y[i] = centres[i].y;
      this->Z[i] = centres[i].z;
    }
  }

  // Distances from the centres, without unit.
  void scaledDistances(const glm::dvec3& rest, Eigen::ArrayXd& scaled) const
  {
    scaled = this->Kernel.scale() *
      ((this->X - rest.x).square() + (this->Y - rest.y).square() + (this->Z - rest.z).square())
        .sqrt();
  }

  // Covariances with the centres.
  void covariances(const glm::dvec3& rest, Eigen::ArrayXd& scratch, Eigen::ArrayXd& result) const
  {
    this->scaledDistances(rest, scratch);
    result = this->Kernel.variance() * (1.0 + scratch + scratch.square() / 3.0) * (-scratch).exp();
  }

  glm::dvec3 displacement(
    const glm::dvec3& rest, Eigen::ArrayXd& scratch, Eigen::ArrayXd& covariance) const
  {
    this->covariances(rest, scratch, covariance);
    const Eigen::RowVector3d sum = covariance.matrix().transpose() * this->Pulls.matrix();
    return { sum[0], sum[1], sum[2] };
  }

  void assemble()
  {
    const auto count = static_cast<std::int64_t>(this->Rows.size());
    this->Lower.resize(count, count);
    parallelFor(0, count, ColumnsAtLeast, [this, count](std::int64_t begin, std::int64_t end) {
      Eigen::ArrayXd scratch;
      Eigen::ArrayXd covariance;
      for (std::int64_t j = begin; j < end; ++j)
      {
        this->covariances(this->Rows[j].point, scratch, covariance);
        for (std::int64_t i = j; i < count; ++i)
        {
          this->Lower(i, j) =
            covariance[this->CentreOf[i]] * glm::dot(this->Rows[i].axis, this->Rows[j].axis);
        }
        this->Lower(j, j) += this->Rows[j].variance;
      }
    });
  }

  Eigen::MatrixXd solve(Eigen::MatrixXd right) const
  {
    this->Lower.triangularView<Eigen::Lower>().solveInPlace(right);
    this->Lower.triangularView<Eigen::Lower>().transpose().solveInPlace(right);
    return right;
  }

  void factorMean(const RigidMean& mean)
  {
    const auto count = static_cast<Eigen::Index>(this->Rows.size());
    this->Basis.resize(count, 6);
    for (Eigen::Index i = 0; i < count; ++i)
    {
      const Row& row = this->Rows[i];
      const Eigen::RowVector3d axis(row.axis.x, row.axis.y, row.axis.z);
      this->Basis.row(i) = axis * meanAt(row.point - mean.centre);
    }
    this->Solved = this->solve(this->Basis);
    Eigen::Matrix<double, 6, 6> precision = this->Basis.transpose() * this->Solved;
    precision.bottomRightCorner<3, 3>().diagonal().array() += mean.rotationPrecision;
    this->Motion.compute(precision);
  }

  // The rows' inverse covariance, times how alike their axes are, summed over rows that share a
  // centre. It is positive definite, as both factors are where they must be (Schur).
  Explained explained() const
  {
    const auto count = static_cast<Eigen::Index>(this->Rows.size());
    Eigen::MatrixXd inverse = Eigen::MatrixXd::Identity(count, count);
    this->Lower.triangularView<Eigen::Lower>().solveInPlace(inverse);
    inverse = (inverse.transpose() * inverse).eval();
    Explained result;
    result.factor.setZero(this->X.size(), this->X.size());
    for (Eigen::Index j = 0; j < count; ++j)
    {
      for (Eigen::Index i = 0; i < count; ++i)
      {
        result.factor(this->CentreOf[i], this->CentreOf[j]) +=
          inverse(i, j) * glm::dot(this->Rows[i].axis, this->Rows[j].axis);
      }
    }
    const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factor(result.factor); // in place
    if (this->Mean)
    {
      result.away.setZero(18, this->X.size());
      for (Eigen::Index i = 0; i < count; ++i)
      {
        const glm::dvec3& axis = this->Rows[i].axis;
        const Eigen::Matrix<double, 3, 6> part =
          Eigen::Vector3d(axis.x, axis.y, axis.z) * this->Solved.row(i);
        result.away.col(this->CentreOf[i]) += part.reshaped();
      }
    }
    return result;
  }

  // A third of the trace of what a mean leaves open; 0 without a mean.
  double openVariance(
    const glm::dvec3& rest, const Eigen::MatrixXd& away, const Eigen::VectorXd& covariance) const
  {
    if (!this->Mean)
    {
      return 0.0;
    }
    const Eigen::Matrix<double, 18, 1> held = away * covariance;
    const Eigen::Matrix<double, 3, 6> open =
      meanAt(rest - this->Mean->centre) - held.reshaped(3, 6);
    return (open * this->Motion.solve(open.transpose())).trace() / 3.0;
  }

  void solveWeights()
  {
    const auto count = static_cast<Eigen::Index>(this->Rows.size());
    Eigen::VectorXd values(count);
    for (Eigen::Index i = 0; i < count; ++i)
    {
      values[i] = this->Rows[i].value;
    }
    this->Weights = this->solve(values);
    this->Pulls.setZero(this->X.size(), 3);
    for (Eigen::Index i = 0; i < count; ++i)
    {
      const glm::dvec3& axis = this->Rows[i].axis;
      this->Pulls.row(this->CentreOf[i]) +=
        this->Weights[i] * Eigen::Array<double, 1, 3>(axis.x, axis.y, axis.z);
    }
  }
};

Process::Process(const Matern& kernel)
  : Internal(std::make_unique<State>())
{
  this->Internal->Kernel = kernel;
}

Process::~Process() = default;
Process::Process(Process&& other) noexcept = default;
Process& Process::operator=(Process&& other) noexcept = default;

void Process::setRows(std::vector<Row> rows, const std::optional<RigidMean>& mean)
{
  if (rows.size() > MostRows)
  {
    throw Problem("The measurements have " + std::to_string(rows.size()) + " rows; at most " +
      std::to_string(MostRows) + " can be solved together (a point has 3, a traced point 1)");
  }
  State& state = *this->Internal;
  state.Rows = std::move(rows);
  state.Mean = mean;
  state.placeCentres();
  state.assemble();
  if (!state.Rows.empty())
  {
    const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factor(state.Lower); // in place
    ++state.Factors;
    if (factor.info() != Eigen::Success)
    {
      throw Problem("The measurements cannot be solved together: some contradict each other");
    }
  }
  if (mean && !state.Rows.empty())
  {
    state.factorMean(*mean);
    if (state.Motion.info() != Eigen::Success)
    {
      throw Problem("The measurements do not determine the rotation of the volume");
    }
  }
  state.solveWeights();
}

void Process::setValues(const std::vector<double>& values)
{
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    this->Internal->Rows[i].value = values[i];
  }
  this->Internal->solveWeights();
}

const std::vector<Row>& Process::rows() const
{
  return this->Internal->Rows;
}

int Process::factors() const
{
  return this->Internal->Factors;
}

SmallMotion Process::remainingMotion(const glm::dvec3& taken) const
{
  const State& state = *this->Internal;
  if (!state.Mean || state.Rows.empty())
  {
    return {};
  }
  Eigen::Matrix<double, 6, 1> pull = state.Basis.transpose() * state.Weights;
  pull.tail<3>() -= state.Mean->rotationPrecision * Eigen::Vector3d(taken.x, taken.y, taken.z);
  const Eigen::Matrix<double, 6, 1> motion = state.Motion.solve(pull);
  return { { motion[0], motion[1], motion[2] }, { motion[3], motion[4], motion[5] } };
}

glm::dvec3 Process::displacement(const glm::dvec3& rest) const
{
  Eigen::ArrayXd scratch;
  Eigen::ArrayXd covariance;
  return this->Internal->displacement(rest, scratch, covariance);
}

std::vector<glm::dvec3> Process::displacements(const std::vector<glm::dvec3>& rest) const
{
  std::vector<glm::dvec3> result(rest.size());
  parallelFor(0, static_cast<std::int64_t>(rest.size()), PointsAtLeast,
    [&](std::int64_t begin, std::int64_t end) {
      Eigen::ArrayXd scratch;
      Eigen::ArrayXd covariance;
      for (std::int64_t i = begin; i < end; ++i)
      {
        result[i] = this->Internal->displacement(rest[i], scratch, covariance);
      }
    });
  return result;
}

FieldValue Process::valueAt(const glm::dvec3& rest) const
{
  const State& state = *this->Internal;
  Eigen::ArrayXd scaled;
  state.scaledDistances(rest, scaled);
  const double scale = state.Kernel.scale();
  const Eigen::ArrayXd decay = state.Kernel.variance() * (-scaled).exp();
  const Eigen::ArrayXd slope = -scale * scale / 3.0 * (1.0 + scaled) * decay;
  Eigen::ArrayX4d weights(state.X.size(), 4);
  weights << (1.0 + scaled + scaled.square() / 3.0) * decay, slope * (rest.x - state.X),
    slope * (rest.y - state.Y), slope * (rest.z - state.Z);
  const Eigen::Matrix<double, 3, 4> sums = state.Pulls.matrix().transpose() * weights.matrix();
  return { { sums(0, 0), sums(1, 0), sums(2, 0) }, glmFrom(sums.rightCols<3>()) };
}

glm::dmat3 Process::covariance(const glm::dvec3& rest) const
{
  const State& state = *this->Internal;
  const auto count = static_cast<Eigen::Index>(state.Rows.size());
  Eigen::Matrix3d result = state.Kernel.variance() * Eigen::Matrix3d::Identity();
  if (count == 0)
  {
    // Nothing holds the free translation of a mean.
    return state.Mean ? glm::dmat3(std::numeric_limits<double>::infinity()) : glmFrom(result);
  }
  Eigen::ArrayXd scratch;
  Eigen::ArrayXd covariance;
  state.covariances(rest, scratch, covariance);
  Eigen::MatrixX3d shared(count, 3);
  for (Eigen::Index i = 0; i < count; ++i)
  {
    const glm::dvec3& axis = state.Rows[i].axis;
    shared.row(i) = covariance[state.CentreOf[i]] * Eigen::RowVector3d(axis.x, axis.y, axis.z);
  }
  Eigen::Matrix<double, 3, 6> away;
  if (state.Mean)
  {
    away = meanAt(rest - state.Mean->centre) - shared.transpose() * state.Solved;
  }
  state.Lower.triangularView<Eigen::Lower>().solveInPlace(shared);
  result -= shared.transpose() * shared;
  if (state.Mean)
  {
    result += away * state.Motion.solve(away.transpose());
  }
  return glmFrom(result);
}

std::vector<double> Process::variances(const std::vector<glm::dvec3>& rest) const
{
  const State& state = *this->Internal;
  std::vector<double> result(rest.size(), state.Kernel.variance());
  const auto count = static_cast<Eigen::Index>(state.Rows.size());
  if (count == 0)
  {
    const double open = std::numeric_limits<double>::infinity();
    std::fill(result.begin(), result.end(), state.Mean ? open : state.Kernel.variance());
    return result;
  }
  const Explained explained = state.explained();
  parallelFor(0, static_cast<std::int64_t>(rest.size()), PointsTogether,
    [&](std::int64_t begin, std::int64_t end) {
      Eigen::ArrayXd scratch;
      Eigen::ArrayXd covariance;
      Eigen::MatrixXd shared(state.X.size(), PointsTogether);
      for (std::int64_t first = begin; first < end; first += PointsTogether)
      {
        const std::int64_t columns = std::min(PointsTogether, end - first);
        for (std::int64_t i = 0; i < columns; ++i)
        {
          state.covariances(rest[first + i], scratch, covariance);
          shared.col(i) = covariance;
        }
        const Eigen::MatrixXd part =
          explained.factor.triangularView<Eigen::Lower>().transpose() * shared.leftCols(columns);
        for (std::int64_t i = 0; i < columns; ++i)
        {
          result[first + i] -= part.col(i).squaredNorm() / 3.0;
          result[first + i] += state.openVariance(rest[first + i], explained.away, shared.col(i));
        }
      }
    });
  return result;
}

std::vector<double> Process::covarianceKey() const
{
  const State& state = *this->Internal;
  std::vector<double> key{ state.Kernel.lengthMm, state.Kernel.deviationMm };
  if (state.Mean)
  {
    const glm::dvec3& centre = state.Mean->centre;
    key.insert(key.end(), { centre.x, centre.y, centre.z, state.Mean->rotationPrecision });
  }
  for (const Row& row : state.Rows)
  {
    key.insert(key.end(),
      { row.point.x, row.point.y, row.point.z, row.axis.x, row.axis.y, row.axis.z, row.variance });
  }
  return key;
}

LeftOut Process::leftOut(std::size_t first) const
{
  const State& state = *this->Internal;
  const auto count = static_cast<Eigen::Index>(state.Rows.size());
  const auto begin = static_cast<Eigen::Index>(first);
  Eigen::MatrixX3d unit = Eigen::MatrixX3d::Zero(count, 3);
  unit.middleRows<3>(begin).setIdentity();
  // Above the three rows the solution is 0.
  state.Lower.bottomRightCorner(count - begin, count - begin)
    .triangularView<Eigen::Lower>()
    .solveInPlace(unit.bottomRows(count - begin));
  Eigen::Matrix3d precision = unit.transpose() * unit;
  if (state.Mean)
  {
    const Eigen::Matrix<double, 3, 6> rows = state.Solved.middleRows<3>(begin);
    precision -= rows * state.Motion.solve(rows.transpose());
  }
  const Eigen::Matrix3d covariance = precision.inverse();
  const Eigen::Vector3d error = covariance * state.Weights.segment<3>(begin);
  return { { error[0], error[1], error[2] }, glmFrom(covariance) };
}
}

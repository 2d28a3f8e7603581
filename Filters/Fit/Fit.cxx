// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Fit/Fit.h"

#include "Common/Numbers.h"
#include "Common/Parallel.h"
#include "Filters/Fit/TraceRows.h"

#include <limits>

namespace brainshift
{
namespace
{
constexpr std::int64_t DeviationsAtLeast = 4; // for a thread
constexpr std::int64_t BendsAtLeast = 256;    // the same
constexpr int MostMotions = 50;
constexpr int ProjectionsOfStart = 2;         // each halves what is left of a bend many times over
constexpr double MotionTolerance = 1e-12;     // mm and rad
constexpr double MotionUnsettled = 1e-6;      // mm and rad: more than rounding moves
constexpr double LeastSpreadMm = 1.0;         // around a line, to know the rotation about it
constexpr double PriorPairs = 8.0;            // weight of the settings against the pairs
constexpr double FarthestDeviationMm = 100.0; // of a pair that is left out: beyond it is unknown

// Adds three rows that measure all of a displacement. Returns the number of the first.
std::size_t addVector(
  std::vector<Row>& rows, const glm::dvec3& at, const glm::dvec3& value, double variance)
{
  const std::size_t first = rows.size();
  for (int axis = 0; axis < 3; ++axis)
  {
    glm::dvec3 unit(0.0);
    unit[axis] = 1.0;
    rows.push_back({ at, unit, value[axis], variance });
  }
  return first;
}

// Adds what pairs that are switched on say beyond the base. Returns their first rows.
std::vector<std::optional<std::size_t>> addPairs(std::vector<Row>& rows,
  const std::vector<PointPair>& pairs, double deviation, const FitBase* base = nullptr)
{
  std::vector<std::optional<std::size_t>> firsts;
  for (const PointPair& pair : pairs)
  {
    firsts.emplace_back();
    if (pair.weight > 0.0)
    {
      const glm::dvec3 before = base ? base->map.deformedFromRest(pair.rest) : pair.rest;
      firsts.back() =
        addVector(rows, pair.rest, pair.measured - before, deviation * deviation / pair.weight);
    }
  }
  return firsts;
}

double squared(double value)
{
  return value * value;
}

// Whether the other measurements determine the position of a pair. Where they leave a rotation or
// a shift open, the covariance is singular or huge.
bool isDetermined(const glm::dmat3& covariance)
{
  const double minor = covariance[0][0] * covariance[1][1] - covariance[1][0] * covariance[0][1];
  const double trace = covariance[0][0] + covariance[1][1] + covariance[2][2];
  // A comparison with NaN is false.
  return covariance[0][0] > 0.0 && minor > 0.0 && glm::determinant(covariance) > 0.0 &&
    trace <= squared(FarthestDeviationMm);
}
}

Fit::Fit()
  : Field(Matern())
{
}

void Fit::solve(const Measurements& measured, const FitSettings& settings,
  const RestSurface& surface, const Process* start)
{
  requireGood(measured);
  requireGood(settings);
  this->Rigid = {};
  this->Open = {};
  this->Base = measured.base;
  this->Steps = 0;
  this->ExpectsSmallRotation = false;
  if (bendsOnly(measured))
  {
    this->solveBend(measured, settings, surface, start);
  }
  else
  {
    this->solveRigid(measured, settings);
  }
  this->judge(measured);
}

void Fit::solveRigid(const Measurements& measured, const FitSettings& settings)
{
  std::vector<glm::dvec3> from;
  std::vector<glm::dvec3> to;
  std::vector<double> weights;
  for (const PointPair& pair : measured.landmarks)
  {
    if (pair.weight > 0.0)
    {
      from.push_back(pair.rest);
      to.push_back(pair.measured);
      weights.push_back(pair.weight);
    }
  }
  std::vector<Row> rows;
  this->PullRows.clear();
  this->LandmarkRows =
    addPairs(rows, measured.landmarks, settings.landmarkDeviation * settings.relaxation);
  const bool saysRotation = spreadAroundLine(from, weights) >= LeastSpreadMm;
  this->ExpectsSmallRotation = !(from.size() >= settings.pairsWithoutPrior && saysRotation);
  const bool isFree = !this->ExpectsSmallRotation;
  const RigidMean mean{ weightedMean(from, weights),
    isFree ? 0.0 : 1.0 / squared(glm::radians(settings.rotationPriorDegrees)) };
  this->Field = Process(settings.landmarkKernel);
  this->Field.setRows(rows, mean);
  if (from.empty())
  {
    return;
  }
  this->Open = openRotationOf(from, weights, settings.landmarkDeviation * settings.relaxation,
    glm::radians(settings.rotationPriorDegrees));
  const glm::dvec3 shift = weightedMean(to, weights) - mean.centre;
  this->Rigid = turnedAround(
    mean.centre, saysRotation ? nearestRotation(from, to, weights) : glm::dmat3(1.0), shift);
  double moved = 0.0;
  for (int i = 0; i < MostMotions; ++i)
  {
    std::vector<double> values;
    for (std::size_t j = 0; j < from.size(); ++j)
    {
      const glm::dvec3 left = this->Rigid.applyInverse(to[j]) - from[j];
      values.insert(values.end(), { left.x, left.y, left.z });
    }
    this->Field.setValues(values);
    const SmallMotion motion = this->Field.remainingMotion(vectorFrom(this->Rigid.rotation));
    const RigidPose step =
      turnedAround(mean.centre, rotationFrom(motion.rotation), motion.translation);
    moved = glm::length(motion.translation) + glm::length(motion.rotation);
    if (moved < MotionTolerance)
    {
      break;
    }
    this->Rigid = { this->Rigid.rotation * step.rotation, this->Rigid.apply(step.translation) };
  }
  if (!(moved < MotionUnsettled)) // also rejects NaN
  {
    throw Problem("The landmarks do not determine the rotation of the volume");
  }
}

void Fit::solveBend(const Measurements& measured, const FitSettings& settings,
  const RestSurface& surface, const Process* start)
{
  const double deviation = settings.surfaceDeviation * settings.relaxation;
  std::vector<Row> rows;
  this->LandmarkRows = addPairs(rows, measured.landmarks, deviation, this->Base.get());
  this->PullRows = addPairs(rows, measured.pulls, deviation, this->Base.get());
  for (const glm::dvec3& pin : measured.pins)
  {
    addVector(rows, pin, glm::dvec3(0.0), squared(settings.pinDeviation));
  }
  for (const SurfacePoint& anchor : measured.anchors)
  {
    rows.push_back({ anchor.position, anchor.normal, 0.0, squared(settings.anchorDeviation) });
  }
  this->Field = Process(settings.surfaceKernel);
  if (measured.traces.empty() || !surface)
  {
    this->Field.setRows(rows);
    return;
  }
  TraceProjection projection(measured.traces, surface, this->Base);
  const TraceBins bins(measured.traces, settings, deviation);
  const int steps = start ? 1 : settings.steps;
  for (int i = 0; start && i < ProjectionsOfStart; ++i)
  {
    projection.project(*start);
  }
  for (this->Steps = 0; this->Steps < steps; ++this->Steps)
  {
    const double moved = start ? 0.0 : projection.project(this->Field);
    if (this->Steps > 1 && moved <= settings.stepToleranceMm)
    {
      break;
    }
    std::vector<Row> all = rows;
    const std::vector<Row> traced = bins.rows(projection.feet());
    all.insert(all.end(), traced.begin(), traced.end());
    this->Field.setRows(all);
  }
}

void Fit::judge(const Measurements& measured)
{
  this->LeaveOneOut.assign(measured.landmarks.size(), NaN);
  double sum = PriorPairs;
  double count = PriorPairs;
  const auto leaveOut = [&](const std::optional<std::size_t>& first) {
    if (!first)
    {
      return NaN;
    }
    const LeftOut left = this->Field.leftOut(*first);
    if (!isDetermined(left.covariance))
    {
      return NaN;
    }
    sum += glm::dot(left.error, glm::inverse(left.covariance) * left.error) / 3.0;
    ++count;
    return glm::length(left.error);
  };
  // One pair alone determines all of the rigid part: without it there is no fit.
  const auto used = std::count_if(this->LandmarkRows.begin(), this->LandmarkRows.end(),
    [](const std::optional<std::size_t>& first) { return first.has_value(); });
  if (used > 1 || bendsOnly(measured))
  {
    std::transform(
      this->LandmarkRows.begin(), this->LandmarkRows.end(), this->LeaveOneOut.begin(), leaveOut);
    std::for_each(this->PullRows.begin(), this->PullRows.end(), leaveOut);
  }
  this->Calibration = std::sqrt(sum / count);
}

double Fit::deviation(const glm::dvec3& rest) const
{
  if (this->Field.rows().empty())
  {
    return std::numeric_limits<double>::infinity();
  }
  const glm::dmat3 covariance = this->Field.covariance(rest);
  return this->deviationOf((covariance[0][0] + covariance[1][1] + covariance[2][2]) / 3.0, rest);
}

double Fit::deviationOf(double variance, const glm::dvec3& rest) const
{
  return this->Field.rows().empty()
    ? std::numeric_limits<double>::infinity()
    : std::hypot(this->Calibration * std::sqrt(std::max(0.0, variance)),
        this->Open.distance(rest) / std::sqrt(3.0));
}

std::vector<glm::dvec3> Fit::bends(const std::vector<glm::dvec3>& rest) const
{
  std::vector<glm::dvec3> result = this->Field.displacements(rest);
  const auto count = static_cast<std::int64_t>(this->Base ? rest.size() : 0);
  parallelFor(0, count, BendsAtLeast, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i)
    {
      result[i] += this->Base->displacement(rest[i]);
    }
  });
  return result;
}

std::vector<double> Fit::deviations(const std::vector<glm::dvec3>& rest) const
{
  std::vector<double> result(rest.size());
  parallelFor(0, static_cast<std::int64_t>(rest.size()), DeviationsAtLeast,
    [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t i = begin; i < end; ++i)
      {
        result[i] = this->deviation(rest[i]);
      }
    });
  return result;
}
}

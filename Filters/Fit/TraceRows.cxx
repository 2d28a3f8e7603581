// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Fit/TraceRows.h"

#include "Common/Parallel.h"

#include <map>
#include <tuple>

namespace brainshift
{
namespace
{
constexpr std::int64_t TracesAtLeast = 32; // for a thread: about 0.1 ms
constexpr double FlatDeterminant = 0.05;   // below it a Newton step leads nowhere
constexpr double OpposedNormals = 0.1;     // length of their mean: both banks of a groove

// Where the bend takes tissue at rest, and the derivatives of that.
struct BentPoint
{
  glm::dvec3 position;
  glm::dmat3 jacobian; // the identity where the bend folds
};

BentPoint bentPoint(const Process& field, const FitBase* base, const glm::dvec3& rest)
{
  const FieldValue value = field.valueAt(rest);
  const glm::dvec3 before = base ? base->map.deformedFromRest(rest) : rest;
  const glm::dmat3 jacobian = (base ? base->map.jacobian(rest) : glm::dmat3(1.0)) + value.gradient;
  return { before + value.displacement,
    glm::determinant(jacobian) > FlatDeterminant ? jacobian : glm::dmat3(1.0) };
}
}

TraceProjection::TraceProjection(
  std::vector<glm::dvec3> traces, RestSurface surface, std::shared_ptr<const FitBase> base)
  : Traces(std::move(traces))
  , Surface(std::move(surface))
  , Base(std::move(base))
  , Feet(this->Traces.size())
{
  for (std::size_t i = 0; i < this->Traces.size(); ++i)
  {
    const glm::dvec3& at = this->Traces[i];
    this->Feet[i].tissue = this->Base ? this->Base->map.restFromDeformed(at) : at;
  }
}

double TraceProjection::project(const Process& field)
{
  const auto count = static_cast<std::int64_t>(this->Traces.size());
  std::vector<double> moved(this->Traces.size(), 0.0);
  const bool bends = !field.rows().empty() || this->Base;
  parallelFor(0, count, TracesAtLeast, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i)
    {
      TraceFoot& trace = this->Feet[i];
      const glm::dvec3 at = this->Traces[i];
      const glm::dvec3 before = trace.tissue;
      glm::dmat3 jacobian(1.0);
      if (bends)
      {
        const BentPoint bent = bentPoint(field, this->Base.get(), before);
        jacobian = bent.jacobian;
        trace.tissue -= glm::inverse(jacobian) * (bent.position - at);
      }
      const std::optional<SurfacePoint> foot = this->Surface(trace.tissue, i);
      trace.counts = foot.has_value();
      moved[i] = glm::length(trace.tissue - before);
      if (foot)
      {
        trace.foot = foot->position;
        // A normal turns with the inverse, transposed.
        trace.normal = glm::normalize(glm::transpose(glm::inverse(jacobian)) * foot->normal);
        trace.value = glm::dot(trace.normal,
          at - (this->Base ? this->Base->map.deformedFromRest(trace.foot) : trace.foot));
      }
    }
  });
  return moved.empty() ? 0.0 : *std::max_element(moved.begin(), moved.end());
}

TraceBins::TraceBins(
  const std::vector<glm::dvec3>& traces, const FitSettings& settings, double deviation)
  : Variance(deviation * deviation)
  , Floor(settings.binFloorMm * settings.binFloorMm)
{
  if (traces.size() <= settings.tracesWithoutBins)
  {
    this->Floor = 0.0;
    for (std::size_t i = 0; i < traces.size(); ++i)
    {
      this->Members.push_back({ i });
    }
    return;
  }
  std::map<std::tuple<double, double, double>, std::vector<std::size_t>> cubes;
  for (std::size_t i = 0; i < traces.size(); ++i)
  {
    const glm::dvec3 cube = glm::floor(traces[i] / settings.binMm);
    cubes[{ cube.x, cube.y, cube.z }].push_back(i);
  }
  for (auto& [cube, members] : cubes)
  {
    this->Members.push_back(std::move(members));
  }
}

std::vector<Row> TraceBins::rows(const std::vector<TraceFoot>& feet) const
{
  std::vector<Row> result;
  for (const std::vector<std::size_t>& members : this->Members)
  {
    Row row;
    double count = 0.0;
    for (const std::size_t i : members)
    {
      const TraceFoot& trace = feet[i];
      if (trace.counts)
      {
        row.point += trace.foot;
        row.axis += trace.normal;
        row.value += trace.value;
        ++count;
      }
    }
    if (count == 0.0 || glm::length(row.axis) < OpposedNormals * count)
    {
      continue;
    }
    row.point /= count;
    row.axis = glm::normalize(row.axis);
    row.value /= count;
    row.variance = this->Variance / count + this->Floor;
    result.push_back(row);
  }
  return result;
}
}

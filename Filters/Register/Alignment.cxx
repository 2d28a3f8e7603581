// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Register/Alignment.h"

#include "Filters/Deformation/Parallel.h"
#include "Filters/Deformation/PointMap.h"
#include "Filters/Register/JointHistogram.h"
#include "Filters/Register/LineSearch.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

namespace brainshift
{
namespace
{
constexpr int Pieces = 8;          // of the samples; each has a histogram of its own
constexpr double Tolerance = 0.01; // of the level's spacing: where a line's lowest place is known
constexpr double Converged = 1e-4; // fraction of the information that a round must gain

// The volume for each level, from coarse to fine. A coarser one is made from the next finer one.
std::vector<Volume> pyramid(const Volume& volume, const std::vector<double>& levelsMm)
{
  std::vector<Volume> levels(levelsMm.size());
  const Range range = rangeOf(volume.values);
  const Volume* from = &volume;
  for (std::size_t level = levelsMm.size(); level-- > 0;)
  {
    levels[level] =
      resampled(smoothed(*from, levelsMm[level]), coarseGrid(volume.grid, levelsMm[level]));
    from = &levels[level];
  }
  for (Volume& level : levels)
  {
    for (float& value : level.values)
    {
      value = range.fraction(value);
    }
  }
  return levels;
}

// Positions on a grid from positions in the world.
struct GridFromWorld
{
  explicit GridFromWorld(const Grid& grid)
    : rotation(glm::transpose(grid.direction))
    , origin(rotation * grid.origin / grid.spacing)
  {
    for (int column = 0; column < 3; ++column)
    {
      this->rotation[column] /= grid.spacing;
    }
  }
  glm::dvec3 operator()(const glm::dvec3& world) const
  {
    return this->rotation * world - this->origin;
  }

  glm::dmat3 rotation;
  glm::dvec3 origin;
};

// A number from 0 to 1 that looks random, the same for the same index.
double scattered(std::uint32_t index, std::uint32_t salt)
{
  std::uint32_t x = index * 2654435761u + salt * 40503u;
  x ^= x >> 16;
  x *= 2246822519u;
  x ^= x >> 13;
  x *= 3266489917u;
  x ^= x >> 16;
  return x / 4294967296.0;
}
}

const double Alignment::LeastOverlap = 0.25;

Alignment::Alignment(RegisteredPair pair, const Lattice* bent, const AlignmentSettings& settings)
  : Settings(settings)
  , Cavity(std::move(pair.cavity))
  , References(pyramid(pair.reference, settings.levelsMm))
{
  const std::vector<Volume> levels = pyramid(pair.rest, settings.levelsMm);
  std::optional<PointMap> map;
  if (bent)
  {
    map.emplace(*bent);
  }
  for (const Volume& level : levels)
  {
    const Mask* inside = pair.inside.inside.empty() ? nullptr : &pair.inside;
    const Volume weights = weightsOf(level.grid, { nullptr, inside, nullptr }, {});
    const double all = std::count(weights.values.begin(), weights.values.end(), 1.0f);
    const double fraction = static_cast<double>(this->Settings.mostSamples) / std::max(1.0, all);
    std::vector<Sample> samples;
    std::uint32_t number = 0;
    const glm::dvec3 last(level.grid.dimensions - 1);
    for (int k = 0; k < level.grid.dimensions.z; ++k)
    {
      for (int j = 0; j < level.grid.dimensions.y; ++j)
      {
        for (int i = 0; i < level.grid.dimensions.x; ++i, ++number)
        {
          if (weights.values[number] <= 0.0f || scattered(number, 0) > fraction)
          {
            continue;
          }
          const glm::dvec3 at =
            glm::clamp(glm::dvec3(i + scattered(number, 1) - 0.5, j + scattered(number, 2) - 0.5,
                         k + scattered(number, 3) - 0.5),
              glm::dvec3(0.0), last);
          const glm::dvec3 rest = level.grid.worldFromGrid(at);
          samples.push_back({ map ? map->deformedFromRest(rest) : rest,
            trilinear(level.values.data(), neighboursOf(level.grid.dimensions, glm::vec3(at)))
              .value });
        }
      }
    }
    this->Samples.push_back(std::move(samples));
  }
  glm::dvec3 squares(0.0);
  const std::vector<Sample>& coarse = this->Samples.front();
  for (const Sample& sample : coarse)
  {
    this->Middle += sample.place / std::max(1.0, static_cast<double>(coarse.size()));
  }
  for (const Sample& sample : coarse)
  {
    const glm::dvec3 away = sample.place - this->Middle;
    squares += away * away / std::max(1.0, static_cast<double>(coarse.size()));
  }
  this->RadiusMm = std::max(1.0, std::sqrt(squares.x + squares.y + squares.z));
}

RigidPose Alignment::motionOf(const Parameters& at) const
{
  const glm::dvec3 rotation = glm::dvec3(at[3], at[4], at[5]) / this->RadiusMm;
  return turnedAround(this->Middle, rotationFrom(rotation), { at[0], at[1], at[2] });
}

double Alignment::loss(const Parameters& at, double* overlap) const
{
  const Volume& reference = this->References[this->Progress.level];
  const std::vector<Sample>& samples = this->Samples[this->Progress.level];
  const RigidPose motion = this->motionOf(at);
  const GridFromWorld inReference(reference.grid);
  const GridFromWorld inCavity(this->Cavity.grid);
  const bool hasCavity = !this->Cavity.inside.empty();
  const glm::ivec3 cavitySides = this->Cavity.grid.dimensions;
  std::vector<JointHistogram> parts(Pieces);
  std::vector<double> within(Pieces, 0.0);
  parallelFor(0, Pieces, 1, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t piece = begin; piece < end; ++piece)
    {
      const std::size_t last = samples.size() * (piece + 1) / Pieces;
      for (std::size_t i = samples.size() * piece / Pieces; i < last; ++i)
      {
        const glm::dvec3 place = motion.applyInverse(samples[i].place);
        const Neighbours found =
          neighboursOf(reference.grid.dimensions, glm::vec3(inReference(place)));
        if (!found.isInside)
        {
          continue;
        }
        within[piece] += 1.0;
        const glm::ivec3 cell = glm::ivec3(glm::floor(inCavity(place) + 0.5));
        const bool isRemoved = hasCavity && cell.x >= 0 && cell.y >= 0 && cell.z >= 0 &&
          cell.x < cavitySides.x && cell.y < cavitySides.y && cell.z < cavitySides.z &&
          this->Cavity.inside[this->Cavity.grid.offset(cell.x, cell.y, cell.z)];
        if (!isRemoved)
        {
          parts[piece].add(samples[i].value, trilinear(reference.values.data(), found).value);
        }
      }
    }
  });
  double all = within[0];
  for (int piece = 1; piece < Pieces; ++piece)
  {
    parts[0].add(parts[piece]);
    all += within[piece];
  }
  const double found = all / std::max(1.0, static_cast<double>(samples.size()));
  if (overlap)
  {
    *overlap = found;
  }
  return found < LeastOverlap ? 0.0 : -parts[0].information();
}

void Alignment::prepareLevel()
{
  for (std::size_t i = 0; i < this->Directions.size(); ++i)
  {
    this->Directions[i] = {};
    this->Directions[i][i] = 1.0;
  }
  this->Line = 0;
  this->Rounds = 0;
  this->BestGain = 0.0;
  this->Loss = this->loss(this->Best);
  const double start = this->loss({});
  if (start < this->Loss) // a coarser level went astray
  {
    this->Best = {};
    this->Loss = start;
  }
  this->RoundStart = this->Best;
  this->RoundStartLoss = this->Loss;
  this->Progress.informationAtStart = -start;
  this->IsPrepared = true;
}

double Alignment::searchLine(const Parameters& direction)
{
  const double spacingMm = this->Settings.levelsMm[this->Progress.level];
  const auto moved = [&](double by) {
    Parameters at = this->Best;
    for (std::size_t i = 0; i < at.size(); ++i)
    {
      at[i] += by * direction[i];
    }
    return at;
  };
  const double stride = this->Rounds == 0 ? spacingMm : 0.25 * spacingMm;
  const LinePoint found = lowestAlong(
    [&](double by) { return this->loss(moved(by)); }, this->Loss, stride, Tolerance * spacingMm);
  const double gain = this->Loss - found.value;
  this->Best = moved(found.at);
  this->Loss = found.value;
  return gain;
}

// Powell (1964): the displacement of the whole round replaces the direction that gained most.
void Alignment::endRound()
{
  const double gain = this->RoundStartLoss - this->Loss;
  const bool isDone =
    gain <= Converged * std::abs(this->Loss) || ++this->Rounds >= this->Settings.mostRounds;
  Parameters way{};
  double length = 0.0;
  for (std::size_t i = 0; i < way.size(); ++i)
  {
    way[i] = this->Best[i] - this->RoundStart[i];
    length += way[i] * way[i];
  }
  if (!isDone && length > 0.0)
  {
    for (double& number : way)
    {
      number /= std::sqrt(length);
    }
    this->Directions[this->BestLine] = this->Directions.back();
    this->Directions.back() = way;
    this->searchLine(way);
  }
  this->Line = 0;
  this->BestGain = 0.0;
  this->RoundStart = this->Best;
  this->RoundStartLoss = this->Loss;
  if (isDone)
  {
    this->finishLevel();
  }
}

void Alignment::finishLevel()
{
  if (this->Progress.level + 1 < static_cast<int>(this->Settings.levelsMm.size()))
  {
    ++this->Progress.level;
    this->IsPrepared = false;
  }
  else
  {
    this->Progress.isFinished = true;
  }
}

const AlignmentProgress& Alignment::step()
{
  if (this->Progress.isFinished)
  {
    return this->Progress;
  }
  if (!this->IsPrepared)
  {
    this->prepareLevel();
  }
  const double gain = this->searchLine(this->Directions[this->Line]);
  if (gain > this->BestGain)
  {
    this->BestGain = gain;
    this->BestLine = this->Line;
  }
  ++this->Progress.steps;
  this->Progress.information = -this->loss(this->Best, &this->Progress.overlap);
  if (++this->Line == static_cast<int>(this->Directions.size()))
  {
    this->endRound();
  }
  this->tellDone();
  return this->Progress;
}

void Alignment::tellDone()
{
  const double levels = static_cast<double>(this->Settings.levelsMm.size());
  const double ofLevel =
    this->IsPrepared ? static_cast<double>(this->Rounds) / this->Settings.mostRounds : 0.0;
  this->Progress.done = this->Progress.isFinished ? 1.0 : (this->Progress.level + ofLevel) / levels;
}

double Alignment::shiftMm() const
{
  return std::sqrt(
    this->Best[0] * this->Best[0] + this->Best[1] * this->Best[1] + this->Best[2] * this->Best[2]);
}

double Alignment::turnDegrees() const
{
  return glm::degrees(std::sqrt(this->Best[3] * this->Best[3] + this->Best[4] * this->Best[4] +
                        this->Best[5] * this->Best[5]) /
    this->RadiusMm);
}

double Alignment::bytes(const Grid& rest, const Grid& reference)
{
  // One volume is smoothed at a time, with the lines that are smoothed beside it.
  return sizeof(float) * 2.5 * static_cast<double>(std::max(rest.count(), reference.count()));
}
}

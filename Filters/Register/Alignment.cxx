// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Register/Alignment.h"

#include "Common/Parallel.h"
#include "Filters/Deformation/PointMap.h"
#include "Filters/Register/Starts.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace brainshift
{
namespace
{
double entropy(const std::vector<double>& counts, double all)
{
  double sum = 0.0;
  for (const double count : counts)
  {
    const double fraction = count / all;
    sum -= fraction > 0.0 ? fraction * std::log(fraction) : 0.0;
  }
  return sum;
}
}

JointHistogram::JointHistogram()
  : Cells(static_cast<std::size_t>(Bins) * Bins, 0.0)
{
}

void JointHistogram::add(float a, float b)
{
  const float atA = std::clamp(a, 0.0f, 1.0f) * (Bins - 1);
  const float atB = std::clamp(b, 0.0f, 1.0f) * (Bins - 1);
  const int lowA = std::min(static_cast<int>(atA), Bins - 2);
  const int lowB = std::min(static_cast<int>(atB), Bins - 2);
  const double fractionA = atA - static_cast<float>(lowA);
  const double fractionB = atB - static_cast<float>(lowB);
  double* cell = &this->Cells[static_cast<std::size_t>(lowA) * Bins + lowB];
  cell[0] += (1.0 - fractionA) * (1.0 - fractionB);
  cell[1] += (1.0 - fractionA) * fractionB;
  cell[Bins] += fractionA * (1.0 - fractionB);
  cell[Bins + 1] += fractionA * fractionB;
  this->Count += 1.0;
}

void JointHistogram::add(const JointHistogram& other)
{
  for (std::size_t i = 0; i < this->Cells.size(); ++i)
  {
    this->Cells[i] += other.Cells[i];
  }
  this->Count += other.Count;
}

double JointHistogram::information() const
{
  if (this->Count <= 0.0)
  {
    return 0.0;
  }
  std::vector<double> ofA(Bins, 0.0);
  std::vector<double> ofB(Bins, 0.0);
  for (int a = 0; a < Bins; ++a)
  {
    for (int b = 0; b < Bins; ++b)
    {
      const double cell = this->Cells[static_cast<std::size_t>(a) * Bins + b];
      ofA[a] += cell;
      ofB[b] += cell;
    }
  }
  return std::max(
    0.0, entropy(ofA, this->Count) + entropy(ofB, this->Count) - entropy(this->Cells, this->Count));
}

namespace
{
constexpr double Golden = 0.381966;
constexpr double Growth = 1.618034;
constexpr int MostSteps = 20; // of each of the two parts

// The minimum of the parabola through three points; the middle point if it has none.
double lowestOfParabola(const LinePoint& a, const LinePoint& b, const LinePoint& c)
{
  const double p = (b.at - a.at) * (b.value - c.value);
  const double q = (b.at - c.at) * (b.value - a.value);
  const double below = 2.0 * (p - q);
  return below != 0.0 ? b.at - ((b.at - a.at) * p - (b.at - c.at) * q) / below : b.at;
}
}

LinePoint lowestAlong(const std::function<double(double)>& function, double valueAtZero,
  double stride, double tolerance)
{
  const auto pointAt = [&](double at) { return LinePoint{ at, function(at) }; };
  LinePoint left{ 0.0, valueAtZero };
  LinePoint middle = pointAt(stride);
  if (middle.value > left.value)
  {
    std::swap(left, middle);
  }
  LinePoint right = pointAt(middle.at + (middle.at > left.at ? stride : -stride));
  for (int step = 0; step < MostSteps && right.value < middle.value; ++step)
  {
    left = middle;
    middle = right;
    right = pointAt(middle.at + Growth * (middle.at - left.at));
  }
  // `middle` is below both others.
  for (int step = 0; step < MostSteps && std::abs(right.at - left.at) > 2.0 * tolerance; ++step)
  {
    const LinePoint& wider =
      std::abs(right.at - middle.at) > std::abs(left.at - middle.at) ? right : left;
    double at = lowestOfParabola(left, middle, right);
    const bool isNew = std::abs(at - middle.at) > 0.5 * tolerance &&
      (at - left.at) * (at - right.at) < 0.0 && step % 3 != 2;
    if (!isNew)
    {
      const double least = 0.5 * tolerance;
      const double part = Golden * (wider.at - middle.at);
      at = middle.at + (std::abs(part) < least ? std::copysign(least, part) : part);
    }
    const LinePoint found = pointAt(at);
    const bool isLower = found.value < middle.value;
    const LinePoint outer = isLower ? middle : found;
    const LinePoint inner = isLower ? found : middle;
    // The outer one replaces the end on its side.
    ((outer.at - inner.at) * (right.at - left.at) > 0.0 ? right : left) = outer;
    middle = inner;
    if (isLower && std::abs(outer.at - inner.at) < 0.5 * tolerance)
    {
      break;
    }
  }
  return middle.value < valueAtZero ? middle : LinePoint{ 0.0, valueAtZero };
}

namespace
{
constexpr int Pieces = 8;                 // of the samples; each has a histogram of its own
constexpr std::size_t FewSamples = 30000; // not worth a second thread
constexpr double LeastGain = 1e-4;        // fraction of the information that a round must gain
constexpr double FarthestStartMm = 30.0;
constexpr double FarthestStartDegrees = 30.0;

// The volume for each level, from coarse to fine. A coarser one is made from the next finer one.
std::vector<Volume> pyramid(const Volume& volume, const std::vector<double>& levelsMm)
{
  std::vector<Volume> levels(levelsMm.size());
  const Range range = rangeOf(volume.values);
  const Volume* from = &volume;
  for (std::size_t level = levelsMm.size(); level-- > 0;)
  {
    levels[level] = sampled(*from, levelsMm[level], coarseGrid(volume.grid, levelsMm[level]));
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

// Positions on a grid that was moved, from positions in the world.
struct MovedGrid
{
  MovedGrid(const Grid& grid, const RigidPose& motion)
    : rotation(glm::transpose(grid.direction))
  {
    for (int column = 0; column < 3; ++column)
    {
      this->rotation[column] /= grid.spacing;
    }
    this->origin = this->rotation * grid.origin;
    this->rotation = this->rotation * glm::transpose(motion.rotation);
    this->origin += this->rotation * motion.translation;
  }
  glm::dvec3 operator()(const glm::dvec3& world) const
  {
    return this->rotation * world - this->origin;
  }

  glm::dmat3 rotation;
  glm::dvec3 origin;
};

// The voxel of a moved mask that is nearest to a position in the world.
struct NearestVoxel
{
  NearestVoxel(const Mask& of, const RigidPose& motion)
    : mask(&of)
    , inMask(of.grid, motion)
  {
  }
  bool isInside(const glm::dvec3& world) const
  {
    const glm::dvec3 at = this->inMask(world) + 0.5;
    const glm::ivec3& sides = this->mask->grid.dimensions;
    return at.x >= 0.0 && at.y >= 0.0 && at.z >= 0.0 && at.x < sides.x && at.y < sides.y &&
      at.z < sides.z &&
      this->mask->inside[this->mask->grid.offset(
        static_cast<int>(at.x), static_cast<int>(at.y), static_cast<int>(at.z))];
  }

  const Mask* mask;
  MovedGrid inMask;
};

// The masks of what a reference lacks that have voxels.
std::vector<Mask> missingOf(const RegisteredPair& pair)
{
  std::vector<Mask> found;
  for (const Mask* mask : { &pair.cavity, &pair.referenceUnknown })
  {
    if (!mask->inside.empty())
    {
      found.push_back(*mask);
    }
  }
  return found;
}

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

Alignment::Alignment(
  const RegisteredPair& pair, const Lattice* bent, const AlignmentSettings& settings)
  : Settings(settings)
  , Missing(missingOf(pair))
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
    const Region region{ nullptr, orNull(pair.inside), { orNull(pair.restUnknown) } };
    const Volume weights = weightsOf(level.grid, region, {});
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
    this->Middle += sample.position / std::max(1.0, static_cast<double>(coarse.size()));
  }
  for (const Sample& sample : coarse)
  {
    const glm::dvec3 away = sample.position - this->Middle;
    squares += away * away / std::max(1.0, static_cast<double>(coarse.size()));
  }
  this->RadiusMm = std::max(1.0, std::sqrt(squares.x + squares.y + squares.z));
}

void Alignment::moveReference(const glm::dmat3& matrix, const glm::dvec3& shift)
{
  const auto move = [&](Grid& grid) {
    grid.direction = matrix * grid.direction;
    grid.origin = matrix * grid.origin + shift;
  };
  for (Volume& level : this->References)
  {
    move(level.grid);
  }
  for (Mask& mask : this->Missing)
  {
    move(mask.grid);
  }
}

// A search that began at a random position may still be far from the best result.
const Alignment::Match& Alignment::bestKnown() const
{
  const bool isBehind = this->Progress.level == 0 && this->Start > 0 &&
    (!this->IsPrepared || this->BestStart.loss <= this->Best.loss);
  return isBehind ? this->BestStart : this->Best;
}

RigidPose Alignment::motionOf(const Parameters& at) const
{
  const glm::dvec3 rotation = glm::dvec3(at[3], at[4], at[5]) / this->RadiusMm;
  return turnedAround(this->Middle, rotationFrom(rotation), { at[0], at[1], at[2] });
}

Alignment::Match Alignment::matched(const Parameters& at) const
{
  const Volume& reference = this->References[this->Progress.level];
  const std::vector<Sample>& samples = this->Samples[this->Progress.level];
  const RigidPose motion = this->motionOf(at);
  const MovedGrid inReference(reference.grid, motion);
  std::vector<NearestVoxel> missing;
  missing.reserve(this->Missing.size());
  for (const Mask& mask : this->Missing)
  {
    missing.emplace_back(mask, motion);
  }
  std::vector<JointHistogram> parts(Pieces);
  std::vector<double> within(Pieces, 0.0);
  const int grain = samples.size() < FewSamples ? Pieces : 1;
  parallelFor(0, Pieces, grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t piece = begin; piece < end; ++piece)
    {
      const std::size_t last = samples.size() * (piece + 1) / Pieces;
      for (std::size_t i = samples.size() * piece / Pieces; i < last; ++i)
      {
        const glm::dvec3& position = samples[i].position;
        const Neighbours found =
          neighboursOf(reference.grid.dimensions, glm::vec3(inReference(position)));
        const auto isThere = [&](const NearestVoxel& mask) { return mask.isInside(position); };
        if (found.isInside && std::none_of(missing.begin(), missing.end(), isThere))
        {
          within[piece] += 1.0;
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
  const double overlap = all / std::max(1.0, static_cast<double>(samples.size()));
  return { at, overlap < LeastOverlap ? 0.0 : -parts[0].information(), overlap };
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
  this->Best = this->matched(this->Best.at);
  const Match start = this->matched({});
  if (this->Progress.level > 0 && start.loss < this->Best.loss) // the coarser level went astray
  {
    this->Best = start;
  }
  this->RoundStart = this->Best;
  this->Progress.informationAtStart = -start.loss;
  this->IsPrepared = true;
}

// A search that comes from far still gains after as many rounds as the coarsest level has.
int Alignment::mostRoundsHere() const
{
  constexpr int RoundsOfFinerLevels = 3; // for each one of the coarsest level
  return this->Settings.mostRounds * (this->Progress.level > 0 ? RoundsOfFinerLevels : 1);
}

double Alignment::searchLine(const Parameters& direction)
{
  const double spacingMm = this->Settings.levelsMm[this->Progress.level];
  const Match from = this->Best;
  const auto lossAt = [&](double by) {
    Parameters at = from.at;
    for (std::size_t i = 0; i < at.size(); ++i)
    {
      at[i] += by * direction[i];
    }
    const Match found = this->matched(at);
    if (found.loss < this->Best.loss)
    {
      this->Best = found;
    }
    return found.loss;
  };
  const double stride = this->Rounds == 0 ? spacingMm : 0.25 * spacingMm;
  lowestAlong(lossAt, from.loss, stride, this->Settings.tolerance * spacingMm);
  return from.loss - this->Best.loss;
}

// Powell (1964): the displacement of the whole round replaces the direction that gained most. His
// test of the extrapolated point is left out.
void Alignment::endRound()
{
  const double gain = this->RoundStart.loss - this->Best.loss;
  const bool isDone =
    gain <= LeastGain * std::abs(this->Best.loss) || ++this->Rounds >= this->mostRoundsHere();
  Parameters displacement{};
  double length = 0.0;
  for (std::size_t i = 0; i < displacement.size(); ++i)
  {
    displacement[i] = this->Best.at[i] - this->RoundStart.at[i];
    length += displacement[i] * displacement[i];
  }
  if (!isDone && length > 0.0)
  {
    for (double& number : displacement)
    {
      number /= std::sqrt(length);
    }
    this->Directions[this->BestLine] = this->Directions.back();
    this->Directions.back() = displacement;
    this->searchLine(displacement);
  }
  this->Line = 0;
  this->BestGain = 0.0;
  this->RoundStart = this->Best;
  this->report();
  if (isDone)
  {
    this->finishLevel();
  }
}

// On the coarsest level. False: there is none left, and the best result of all goes on.
bool Alignment::takeNextStart()
{
  if (this->Start == 0 || this->Best.loss < this->BestStart.loss)
  {
    this->BestStart = this->Best;
  }
  if (++this->Start >= std::min(this->Settings.starts, MostStarts))
  {
    this->Best = this->BestStart;
    return false;
  }
  const StartMotion motion = startMotion(this->Start, FarthestStartMm, FarthestStartDegrees);
  for (int axis = 0; axis < 3; ++axis)
  {
    this->Best.at[axis] = motion.shift[axis];
    this->Best.at[3 + axis] = motion.rotation[axis] * this->RadiusMm;
  }
  this->IsPrepared = false;
  return true;
}

void Alignment::finishLevel()
{
  if (this->Progress.level == 0 && this->takeNextStart())
  {
    return;
  }
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
  if (++this->Line == static_cast<int>(this->Directions.size()))
  {
    this->endRound();
  }
  else
  {
    this->report();
  }
  this->reportDone();
  return this->Progress;
}

void Alignment::report()
{
  const Match& best = this->bestKnown();
  this->Progress.information = -best.loss;
  this->Progress.overlap = best.overlap;
}

void Alignment::reportDone()
{
  const double levels = static_cast<double>(this->Settings.levelsMm.size());
  double ofLevel =
    this->IsPrepared ? static_cast<double>(this->Rounds) / this->mostRoundsHere() : 0.0;
  if (this->Progress.level == 0)
  {
    ofLevel = (this->Start + ofLevel) / std::max(1, this->Settings.starts);
  }
  this->Progress.done = this->Progress.isFinished ? 1.0 : (this->Progress.level + ofLevel) / levels;
}

double Alignment::shiftMm() const
{
  const Parameters& at = this->bestKnown().at;
  return std::sqrt(at[0] * at[0] + at[1] * at[1] + at[2] * at[2]);
}

double Alignment::rotationDegrees() const
{
  const Parameters& at = this->bestKnown().at;
  return glm::degrees(std::sqrt(at[3] * at[3] + at[4] * at[4] + at[5] * at[5]) / this->RadiusMm);
}

double Alignment::bytes(const Grid& rest, const Grid& reference)
{
  // One volume is smoothed at a time, with the lines that are smoothed beside it.
  return sizeof(float) * 2.5 * static_cast<double>(std::max(rest.count(), reference.count()));
}
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Register/Orientations.h"

#include "Common/Numbers.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace brainshift
{
namespace
{
constexpr double CoarseMm = 8.0;
constexpr double FineMm = 4.0;
constexpr std::size_t CoarseSamples = 4000;
constexpr std::size_t FineSamples = 20000;
constexpr double Tolerance = 0.1;     // of a search, as a fraction of the spacing
constexpr int AsItIs = 2;             // candidates: before the registration, and after it
constexpr int Finals = 3;             // beside the reference as it is
constexpr double Alike = 0.9;         // of the information on the coarse level
constexpr std::size_t Searched = 12;  // of the 48 orientations
constexpr float Air = 0.1f;           // fraction of the range of values
constexpr double SameMm = 4.0;        // searches that end nearer to each other found one place
constexpr double SameRotation = 0.05; // the same, rad

// A mask with voxels of a coarse grid.
Mask coarseMask(const Mask& mask)
{
  Mask result;
  if (!mask.inside.empty())
  {
    result.grid = coarseGrid(mask.grid, FineMm);
    const Volume weights = weightsOf(result.grid, { nullptr, &mask, {} }, {});
    result.inside.assign(weights.values.begin(), weights.values.end());
  }
  return result;
}

Volume coarseVolume(const Volume& volume)
{
  return sampled(volume, FineMm, coarseGrid(volume.grid, FineMm));
}

// The mean position of what is brighter than air (mm, world).
glm::dvec3 tissueMiddle(const Volume& volume)
{
  const Range range = rangeOf(volume.values);
  const glm::ivec3& sides = volume.grid.dimensions;
  glm::dvec3 sum(0.0);
  double count = 0.0;
  for (std::size_t number = 0; number < volume.values.size(); ++number)
  {
    if (range.fraction(volume.values[number]) > Air)
    {
      const int row = static_cast<int>(number / sides.x);
      sum += glm::dvec3(static_cast<int>(number % sides.x), row % sides.y, row / sides.y);
      count += 1.0;
    }
  }
  return volume.grid.worldFromGrid(count > 0.0 ? sum / count : 0.5 * glm::dvec3(sides - 1));
}

bool hasMore(const Orientation& a, const Orientation& b)
{
  return a.information > b.information;
}

// Whether two searches ended in one place; `middle` is that of the reference (mm, world).
bool areSame(const Orientation& a, const Orientation& b, const glm::dvec3& middle)
{
  const glm::dvec3 apart = a.placement * middle + a.shift - (b.placement * middle + b.shift);
  return a.matrix == b.matrix && glm::length(apart) < SameMm &&
    glm::length(vectorFrom(a.placement * glm::transpose(b.placement))) < SameRotation;
}

AlignmentSettings settingsOf(std::vector<double> levelsMm, std::size_t samples, int rounds)
{
  AlignmentSettings settings;
  settings.levelsMm = std::move(levelsMm);
  settings.mostSamples = samples;
  settings.mostRounds = rounds;
  settings.tolerance = Tolerance;
  return settings;
}
}

const std::vector<glm::dmat3>& allOrientations()
{
  static const std::vector<glm::dmat3> all = [] {
    std::vector<glm::dmat3> found;
    glm::ivec3 order(0, 1, 2);
    do
    {
      for (int signs = 0; signs < 8; ++signs)
      {
        glm::dmat3 matrix(0.0);
        for (int axis = 0; axis < 3; ++axis)
        {
          matrix[axis][order[axis]] = signs >> axis & 1 ? -1.0 : 1.0;
        }
        found.push_back(matrix);
      }
    } while (std::next_permutation(&order[0], &order[0] + 3));
    return found;
  }();
  return all;
}

OrientationSearch::OrientationSearch(
  const RegisteredPair& pair, const Lattice& start, const Lattice& result)
  : Whole(pair)
  , Start(start)
  , Result(result)
{
}

OrientationSearch::Level OrientationSearch::levelOf(const AlignmentSettings& settings) const
{
  return { std::make_unique<Alignment>(this->Pair, &this->Start, settings),
    std::make_unique<Alignment>(this->Pair, &this->Result, settings) };
}

void OrientationSearch::read()
{
  if (this->Pair.rest.values.empty())
  {
    this->Pair.rest = coarseVolume(this->Whole.rest);
    this->Pair.inside = coarseMask(this->Whole.inside);
    this->Pair.restUnknown = coarseMask(this->Whole.restUnknown);
    this->RestMiddle = tissueMiddle(this->Pair.rest);
    return;
  }
  this->Pair.reference = coarseVolume(this->Whole.reference);
  this->Pair.cavity = coarseMask(this->Whole.cavity);
  this->Pair.referenceUnknown = coarseMask(this->Whole.referenceUnknown);
  this->ReferenceMiddle = tissueMiddle(this->Pair.reference);
  this->Coarse = this->levelOf(settingsOf({ CoarseMm }, CoarseSamples, 2));
}

Alignment OrientationSearch::placed(const Orientation& one, const Level& level)
{
  Alignment search = *level[one.isBent ? 1 : 0];
  search.moveReference(one.placement, one.shift);
  return search;
}

// The search begins where the last one ended.
void OrientationSearch::search(Orientation& one, const Level& level)
{
  Alignment search = placed(one, level);
  while (!search.progress().isFinished)
  {
    search.step();
  }
  const RigidPose motion = search.motion();
  one.placement = motion.rotation * one.placement;
  one.shift = motion.apply(one.shift);
  one.information = search.progress().information;
}

// The reference as it is, then the orientations that match best where the middles meet.
void OrientationSearch::glance()
{
  const glm::dmat3& axes = this->Pair.rest.grid.direction;
  std::vector<Orientation> others;
  for (const glm::dmat3& matrix : allOrientations())
  {
    Orientation one;
    one.matrix = matrix;
    one.placement = axes * matrix * glm::transpose(axes);
    one.shift = this->RestMiddle - one.placement * this->ReferenceMiddle;
    one.information = placed(one, this->Coarse).information();
    others.push_back(one);
  }
  std::sort(others.begin(), others.end(), hasMore);
  this->Candidates.resize(AsItIs);
  this->Candidates.back().isBent = true;
  this->Candidates.insert(this->Candidates.end(), others.begin(), others.begin() + Searched);
}

// The finer level changes the order of those that are alike, and of no others.
void OrientationSearch::choose()
{
  this->Candidates.erase(
    this->Candidates.begin() + (hasMore(this->Candidates[0], this->Candidates[1]) ? 1 : 0));
  const auto isAsItIs = [&](const Orientation& one) {
    return areSame(one, this->Candidates.front(), this->ReferenceMiddle);
  };
  this->Candidates.erase(
    std::remove_if(this->Candidates.begin() + 1, this->Candidates.end(), isAsItIs),
    this->Candidates.end());
  std::sort(this->Candidates.begin() + 1, this->Candidates.end(), hasMore);
  const double least = Alike * this->Candidates.front().information;
  const auto isOpen = [&](const Orientation& one) { return one.information >= least; };
  const auto open =
    std::count_if(this->Candidates.begin() + 1, this->Candidates.begin() + 1 + Finals, isOpen);
  this->Refined = open > 0 ? 0 : 2; // none need be compared on the finer level
  if (open > 0)
  {
    this->Fine = this->levelOf(settingsOf({ FineMm }, FineSamples, 3));
  }
  this->Candidates.resize(2 + std::max<std::ptrdiff_t>(0, open - 1));
}

bool OrientationSearch::step()
{
  if (!this->Coarse.front())
  {
    this->read();
    return true;
  }
  if (this->Candidates.empty())
  {
    this->glance();
    return true;
  }
  constexpr std::size_t all = AsItIs + Searched;
  if (this->Tried < all)
  {
    this->search(this->Candidates[this->Tried], this->Coarse);
    if (++this->Tried == all)
    {
      this->choose();
    }
  }
  else if (this->Refined < this->Candidates.size())
  {
    this->search(this->Candidates[this->Refined++], this->Fine);
    if (this->Refined == this->Candidates.size())
    {
      std::sort(this->Candidates.begin() + 1, this->Candidates.end(), hasMore);
    }
  }
  return this->Tried < all || this->Refined < this->Candidates.size();
}

double OrientationSearch::done() const
{
  const double tried = static_cast<double>(this->Tried) / (AsItIs + Searched);
  const double refined = static_cast<double>(this->Refined) / (1 + Finals);
  return 0.5 * (tried + std::min(1.0, refined));
}

namespace
{
constexpr const char* Ways[] = { "left to right", "back to front", "bottom to top" };

// The world axis that a direction is nearest to.
int nearestAxis(const glm::dvec3& direction)
{
  const glm::dvec3 size = glm::abs(direction);
  return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
}

std::string rotationText(const glm::dmat3& rotation, const glm::dmat3& axes)
{
  const glm::dvec3 vector = vectorFrom(rotation);
  const double angle = glm::length(vector);
  if (angle < 1e-6)
  {
    return {};
  }
  // An axis of rotation is a pseudovector: left-handed axes reverse it.
  const glm::dvec3 about = glm::determinant(axes) * (axes * (vector / angle));
  std::string text = "rotated by " + std::to_string(std::lround(glm::degrees(angle))) +
    " degrees about the direction (";
  for (int axis = 0; axis < 3; ++axis)
  {
    text += (axis ? ", " : "") + numberText(std::round(100.0 * about[axis]) / 100.0 + 0.0);
  }
  return text + ")";
}
}

std::string orientationText(const glm::dmat3& matrix, const glm::dmat3& axes)
{
  if (glm::determinant(matrix) > 0.0)
  {
    const std::string rotated = rotationText(matrix, axes);
    return rotated.empty() ? "moved, in its present orientation" : rotated;
  }
  std::string text;
  for (int axis = 0; axis < 3; ++axis)
  {
    glm::dmat3 mirror(1.0);
    mirror[axis][axis] = -1.0;
    const std::string rotation = rotationText(matrix * mirror, axes);
    if (axis == 0 || rotation.empty())
    {
      text = std::string("mirrored from ") + Ways[nearestAxis(axes[axis])] +
        (rotation.empty() ? "" : " and then " + rotation);
    }
  }
  return text;
}
}

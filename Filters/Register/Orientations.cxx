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
constexpr int Finals = 3;          // beside the reference as it is
constexpr std::size_t Trials = 49; // as it is, and 48 orientations
constexpr float Air = 0.1f;        // fraction of the range of values

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
  return resampled(smoothed(volume, FineMm), coarseGrid(volume.grid, FineMm));
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

AlignmentSettings settingsOf(std::vector<double> levelsMm, std::size_t samples, int rounds)
{
  AlignmentSettings settings;
  settings.levelsMm = std::move(levelsMm);
  settings.mostSamples = samples;
  settings.mostRounds = rounds;
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

OrientationSearch::OrientationSearch(const RegisteredPair& pair, const Lattice& bent)
  : Whole(pair)
  , Bent(bent)
{
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
}

double OrientationSearch::informationOf(
  const Orientation& one, const AlignmentSettings& settings) const
{
  RegisteredPair pair = this->Pair;
  if (one.isMoved)
  {
    const glm::dmat3& axes = pair.rest.grid.direction;
    const glm::dmat3 whole = axes * one.matrix * glm::transpose(axes);
    for (Grid* grid : { &pair.reference.grid, &pair.cavity.grid, &pair.referenceUnknown.grid })
    {
      grid->direction = whole * grid->direction;
      grid->origin = this->RestMiddle + whole * (grid->origin - this->ReferenceMiddle);
    }
  }
  Alignment search(pair, &this->Bent, settings);
  while (!search.progress().isFinished)
  {
    search.step();
  }
  return search.progress().information;
}

void OrientationSearch::choose()
{
  this->Finalists.push_back(this->Tried.front());
  std::sort(this->Tried.begin() + 1, this->Tried.end(), hasMore);
  this->Finalists.insert(
    this->Finalists.end(), this->Tried.begin() + 1, this->Tried.begin() + 1 + Finals);
}

bool OrientationSearch::step()
{
  if (this->Pair.reference.values.empty())
  {
    this->read();
    return true;
  }
  if (this->Tried.size() < Trials)
  {
    Orientation one;
    one.isMoved = !this->Tried.empty();
    one.matrix = allOrientations()[one.isMoved ? this->Tried.size() - 1 : 0];
    one.information = this->informationOf(one, settingsOf({ CoarseMm }, CoarseSamples, 2));
    this->Tried.push_back(one);
    if (this->Tried.size() == Trials)
    {
      this->choose();
    }
    return true;
  }
  if (this->Refined < this->Finalists.size())
  {
    Orientation& one = this->Finalists[this->Refined++];
    one.information = this->informationOf(one, settingsOf({ CoarseMm, FineMm }, FineSamples, 3));
    if (this->Refined == this->Finalists.size())
    {
      std::sort(this->Finalists.begin() + 1, this->Finalists.end(), hasMore);
    }
  }
  return this->Refined < this->Finalists.size();
}

double OrientationSearch::done() const
{
  return static_cast<double>(this->Tried.size() + this->Refined) / (Trials + 1 + Finals);
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
  const glm::dvec3 about = axes * (vector / angle);
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

// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Register/RefinementState.h"

#include <glm/matrix.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace brainshift
{
namespace
{
std::vector<glm::vec3> rotated(const std::vector<glm::vec3>& vectors, const glm::dmat3& by)
{
  const glm::mat3 rotation(by);
  std::vector<glm::vec3> result;
  result.reserve(vectors.size());
  for (const glm::vec3& vector : vectors)
  {
    result.push_back(rotation * vector);
  }
  return result;
}

Controls controlsOf(const Lattice& lattice)
{
  return rotated(lattice.displacements, glm::transpose(lattice.grid.direction));
}
}

RefinementState::RefinementState(const Lattice& from, const RefinementSettings& settings)
  : start(from)
  , bent(from)
  , startControls(controlsOf(from))
  , unbent(startControls)
  , controls(startControls)
  , Guards(settings.guards)
{
  // Cells that fold by themselves at the start are left alone.
  this->Guard.setBase(from, settings.samples);
  this->progress.isFinished = settings.plan.levels.empty();
  this->progress.stiffness = settings.stiffness;
}

void RefinementState::setStiffness(double factor)
{
  this->StiffnessFactor = factor;
  this->stiffness = Stiffness(this->start.grid, factor * this->progress.stiffness);
}

void RefinementState::stiffen(double factor)
{
  this->progress.stiffness *= factor;
  this->setStiffness(this->StiffnessFactor);
  this->energy = this->energyOf(this->controls, this->known);
}

Controls RefinementState::bendOf(const Controls& at) const
{
  Controls bend = at;
  for (std::size_t i = 0; i < bend.size(); ++i)
  {
    bend[i] -= this->unbent[i];
  }
  return bend;
}

double RefinementState::energyOf(const Controls& at, const CostAndForces& compared) const
{
  const Controls bend = this->bendOf(at);
  return compared.cost + dot(bend, this->stiffness.times(bend));
}

Lattice RefinementState::latticeOf(const Controls& at) const
{
  Lattice result = this->start;
  result.displacements = rotated(at, this->start.grid.direction);
  return result;
}

RefinementState::Candidate RefinementState::candidateAt(const Controls& step, double length) const
{
  Candidate found;
  found.controls = this->controls;
  for (std::size_t i = 0; i < step.size(); ++i)
  {
    found.controls[i] += static_cast<float>(length) * step[i];
  }
  found.lattice = this->latticeOf(found.controls);
  found.fraction = this->Guards ? this->Guard.fraction(this->bent, found.lattice) : 1.0;
  if (found.fraction < 1.0)
  {
    found.lattice = between(this->bent, found.lattice, found.fraction);
    found.controls = controlsOf(found.lattice);
  }
  return found;
}

void RefinementState::take(const Lattice& lattice, CostAndForces compared, double energyThere)
{
  this->bent = lattice;
  this->controls = controlsOf(lattice);
  this->known = std::move(compared);
  this->energy = energyThere;
  this->progress.cost = this->known.cost;
}

void RefinementState::beginLevel(CostAndForces here, CostAndForces atStart)
{
  this->progress.costAtStart = atStart.cost;
  this->samplesAtStart = atStart.samples;
  const double energyHere = this->energyOf(this->controls, here);
  if (energyHere > atStart.cost)
  {
    const double energyAtStart = atStart.cost;
    this->unbent = this->startControls;
    this->take(this->start, std::move(atStart), energyAtStart);
  }
  else
  {
    this->take(this->bent, std::move(here), energyHere);
  }
}
}

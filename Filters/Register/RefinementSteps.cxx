// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Register/RefinementSteps.h"

#include "Filters/Fit/RigidPose.h"

#include <Eigen/Cholesky>

#include <optional>
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

// The place of a control point, mm along the grid's axes from the first one.
glm::dvec3 placeOf(const Grid& lattice, std::size_t number)
{
  const int row = static_cast<int>(number) / lattice.dimensions.x;
  const glm::ivec3 index(static_cast<int>(number) % lattice.dimensions.x,
    row % lattice.dimensions.y, row / lattice.dimensions.y);
  return lattice.spacing * glm::dvec3(index);
}

Controls difference(Controls of, const Controls& from)
{
  for (std::size_t i = 0; i < of.size(); ++i)
  {
    of[i] -= from[i];
  }
  return of;
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
  return difference(at, this->unbent);
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

RefinementState::Candidate RefinementState::candidateAt(
  const Controls& step, double length, bool isRigid) const
{
  Candidate found;
  found.controls = this->controls;
  for (std::size_t i = 0; i < step.size(); ++i)
  {
    found.controls[i] += static_cast<float>(length) * step[i];
  }
  found.lattice = this->latticeOf(found.controls);
  // Of a rigid motion only the edge of a mask can fold.
  const bool canFold = !isRigid || this->start.mask;
  found.fraction = this->Guards && canFold ? this->Guard.fraction(this->bent, found.lattice) : 1.0;
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

void RefinementState::beginLevel(CostAndForces here, const CostAndForces& atStart)
{
  this->progress.costAtStart = atStart.cost;
  this->samplesAtStart = atStart.samples;
  const double energyHere = this->energyOf(this->controls, here);
  this->take(this->bent, std::move(here), energyHere);
}

void RefinementState::returnIfWorse(const CostAndForces& atStart)
{
  if (this->energy > atStart.cost)
  {
    this->unbent = this->startControls;
    this->take(this->start, atStart, atStart.cost);
  }
}

void RefinementState::moveTo(const RigidPosition& position)
{
  this->unbent = position.unbent;
  this->controls = position.controls;
  this->bent = this->latticeOf(position.controls);
}

void RefinementState::moveTo(const Lattice& lattice)
{
  this->bent = lattice;
  this->controls = controlsOf(lattice);
  this->unbent = this->controls;
}

RigidPosition RefinementState::startNear(
  const glm::dvec3& middle, int number, double farthest) const
{
  RigidPosition result{ this->startControls, this->startControls };
  const StartMotion motion = startMotion(number, farthest, farthest);
  if (number == 0)
  {
    return result;
  }
  const glm::dmat3 rotation = rotationFrom(motion.rotation);
  const Grid& grid = this->start.grid;
  const glm::dvec3 about = glm::transpose(grid.direction) * (middle - grid.origin);
  Controls step(result.controls.size());
  for (std::size_t i = 0; i < step.size(); ++i)
  {
    const glm::dvec3 arm = placeOf(grid, i) + glm::dvec3(this->startControls[i]) - about;
    step[i] = glm::vec3(motion.shift + rotation * arm - arm);
  }
  result.controls = this->candidateAt(step, 1.0, true).controls;
  result.unbent = result.controls;
  return result;
}

namespace
{
constexpr int MostHalvings = 4;
constexpr double Halving = 0.5;

// A step that would fold is computed again with a stiffer volume: so often, so much stiffer.
constexpr int MostStiffenings = 3;
constexpr double Stiffening = 1.5;

// A factor on the Gauss-Newton step, and its growth after each step that lowers the cost.
constexpr double LongestRigidStep = 64.0;
constexpr double RigidGrowth = 2.0;
constexpr double RigidShortening = 0.25;
constexpr double LeastRigidStepMm = 0.02;
constexpr double LeastInSight = 0.75; // of the samples that were compared at the start

constexpr int Parameters = 6; // a translation along three axes, then a rotation around them

// Of the Hessian's diagonal: a rotation without any force against it stays small.
constexpr double Damping = 1e-3;

glm::dmat3 hessianOf(const float* force)
{
  return { force[3], force[6], force[7], force[6], force[4], force[8], force[7], force[8],
    force[5] };
}

// The motion of a control point at `arm` from the middle, for each of the six parameters.
void motionsOf(const glm::dvec3& arm, glm::dvec3* motions)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    glm::dvec3 unit(0.0);
    unit[axis] = 1.0;
    motions[axis] = unit;
    motions[3 + axis] = glm::cross(unit, arm);
  }
}

// The normal equations of a motion.
struct Equations
{
  Eigen::Matrix<double, Parameters, Parameters> matrix =
    Eigen::Matrix<double, Parameters, Parameters>::Zero();
  Eigen::Matrix<double, Parameters, 1> right = Eigen::Matrix<double, Parameters, 1>::Zero();

  void add(const glm::dvec3& arm, const float* force)
  {
    glm::dvec3 motions[Parameters];
    motionsOf(arm, motions);
    const glm::dmat3 hessian = hessianOf(force);
    for (int row = 0; row < Parameters; ++row)
    {
      const glm::dvec3 image = hessian * motions[row];
      for (int column = 0; column < Parameters; ++column)
      {
        this->matrix(row, column) += glm::dot(image, motions[column]);
      }
      this->right(row) += glm::dot(motions[row], glm::dvec3(force[0], force[1], force[2]));
    }
  }
};

// Positions of control points (mm along the grid's axes), from the centre of the forces.
std::vector<glm::dvec3> armsOf(
  const Grid& lattice, const std::vector<glm::vec3>& displacements, const ControlForces& forces)
{
  std::vector<glm::dvec3> arms(displacements.size());
  glm::dvec3 middle(0.0);
  double weights = 0.0;
  for (std::size_t i = 0; i < arms.size(); ++i)
  {
    arms[i] = placeOf(lattice, i) + glm::dvec3(displacements[i]);
    const double weight = weightOf(&forces[i * ForceNumbers]);
    middle += weight * arms[i];
    weights += weight;
  }
  for (glm::dvec3& arm : arms)
  {
    arm -= weights > 0.0 ? middle / weights : glm::dvec3(0.0);
  }
  return arms;
}

double longest(const Controls& vectors)
{
  float result = 0.0f;
  for (const glm::vec3& vector : vectors)
  {
    result = std::max(result, glm::length(vector));
  }
  return result;
}
}

RigidStep rigidStep(
  const Grid& lattice, const std::vector<glm::vec3>& displacements, const ControlForces& forces)
{
  RigidStep result;
  result.steps.resize(displacements.size(), glm::vec3(0.0f));
  const std::vector<glm::dvec3> arms = armsOf(lattice, displacements, forces);
  Equations equations;
  for (std::size_t i = 0; i < arms.size(); ++i)
  {
    equations.add(arms[i], &forces[i * ForceNumbers]);
  }
  equations.matrix.diagonal() *= 1.0 + Damping;
  const Eigen::LLT<Eigen::Matrix<double, Parameters, Parameters>> factor(equations.matrix);
  if (factor.info() != Eigen::Success)
  {
    return result; // no force
  }
  const Eigen::Matrix<double, Parameters, 1> motion = factor.solve(equations.right);
  const glm::dvec3 shift(motion(0), motion(1), motion(2));
  const glm::dvec3 rotation(motion(3), motion(4), motion(5));
  for (std::size_t i = 0; i < arms.size(); ++i)
  {
    const glm::dvec3 step = shift + glm::cross(rotation, arms[i]);
    result.steps[i] = glm::vec3(step);
    const bool isHeld = weightOf(&forces[i * ForceNumbers]) > 0.0;
    result.lengthMm = std::max(result.lengthMm, isHeld ? glm::length(step) : 0.0);
  }
  return result;
}

void BendStep::find(BendTrial& trial, const RefinementState& state)
{
  Controls pull = pullOf(state.stiffness, state.known.forces, state.bendOf(state.controls));
  std::optional<StepTaken> last;
  if (!this->Before.empty())
  {
    last =
      StepTaken{ difference(state.controls, this->Before), difference(this->PullBefore, pull) };
  }
  this->Before = state.controls;
  this->PullBefore = pull;
  trial.step =
    newtonStep(state.stiffness, state.known.forces, std::move(pull), last ? &*last : nullptr);
  trial.lengthMm = longest(trial.step);
  trial.fraction = trial.lengthMm > this->LongestMm ? this->LongestMm / trial.lengthMm : 1.0;
}

StepOutcome BendStep::attempt(RefinementState& state, PyramidLevel& level)
{
  if (!this->Trying)
  {
    this->Trying = std::make_unique<BendTrial>();
    this->find(*this->Trying, state);
  }
  StepOutcome outcome = this->attempt(*this->Trying, state, level);
  if (outcome == StepOutcome::Open && ++this->Trying->attempts > MostHalvings + MostStiffenings)
  {
    state.progress.movedMm = 0.0;
    outcome = StepOutcome::Settled;
  }
  if (outcome != StepOutcome::Open)
  {
    this->Trying = nullptr;
  }
  return outcome;
}

StepOutcome BendStep::attempt(BendTrial& trial, RefinementState& state, PyramidLevel& level)
{
  const RefinementState::Candidate candidate = state.candidateAt(trial.step, trial.fraction);
  if (candidate.fraction < 1.0 && trial.stiffenings++ < MostStiffenings)
  {
    state.stiffen(Stiffening);
    this->Before.clear(); // another energy
    this->find(trial, state);
    return StepOutcome::Open;
  }
  CostAndForces compared = level.compare(candidate.controls);
  const double energy = state.energyOf(candidate.controls, compared);
  state.progress.stepFraction = std::min(state.progress.stepFraction, candidate.fraction);
  if (!(energy < state.energy)) // also rejects NaN
  {
    trial.fraction *= Halving;
    return StepOutcome::Open;
  }
  const double gain = state.energy - energy;
  state.progress.movedMm = trial.fraction * candidate.fraction * trial.lengthMm;
  state.take(candidate.lattice, std::move(compared), energy);
  return gain > this->Converged * energy ? StepOutcome::Improved : StepOutcome::Settled;
}

StepOutcome RigidMove::attempt(RefinementState& state, PyramidLevel& level)
{
  const RigidStep step = rigidStep(state.start.grid, state.controls, state.known.forces);
  const double fraction =
    std::min(this->StepLength, this->LongestMm / std::max(1e-9, step.lengthMm));
  const RefinementState::Candidate candidate = state.candidateAt(step.steps, fraction, true);
  CostAndForces compared = level.compare(candidate.controls);
  const double gain = state.known.cost - compared.cost; // the bend costs the same
  // A mean also falls if tissue with a high cost leaves the fan.
  const bool staysInSight = compared.samples >= LeastInSight * state.samplesAtStart;
  state.progress.movedMm = 0.0;
  state.progress.stepFraction = std::min(state.progress.stepFraction, candidate.fraction);
  if (!(gain > 0.0) || !staysInSight)
  {
    this->StepLength = RigidShortening * fraction;
    return this->StepLength * step.lengthMm > LeastRigidStepMm ? StepOutcome::Open
                                                               : StepOutcome::Settled;
  }
  for (std::size_t i = 0; i < state.unbent.size(); ++i)
  {
    state.unbent[i] += candidate.controls[i] - state.controls[i];
  }
  state.progress.movedMm = fraction * candidate.fraction * step.lengthMm;
  state.take(candidate.lattice, std::move(compared), state.energy - gain);
  this->StepLength = std::min(LongestRigidStep, RigidGrowth * fraction);
  return gain > this->Converged * state.energy ? StepOutcome::Improved : StepOutcome::Settled;
}

std::unique_ptr<RefinementStep> makeStep(
  const RefinementPlan& plan, const RefinementLevel& level, const Grid& samples)
{
  constexpr double LongestBend = 1.5; // points
  constexpr double LongestMove = 3.0; // longer strides of a rigid motion pass over small minima
  const glm::dvec3 spacing = samples.spacing;
  const double pointMm = std::max(spacing.x, std::max(spacing.y, spacing.z));
  if (level.isRigid)
  {
    return std::make_unique<RigidMove>(LongestMove * pointMm, plan.converged);
  }
  return std::make_unique<BendStep>(LongestBend * pointMm, plan.converged);
}
}

// SPDX-License-Identifier: BSD-3-Clause
// The reference is ultrasound inside a fan. Speckle pulls each position in a random direction; the
// six parameters of a rigid motion average it out, so the volume moves as a whole before it bends.
// Self-similarity finds the position from several millimetres away; LC2 in small windows, whose
// minimum is narrow, then makes it more exact. Neither is compared more than 1 mm apart: a sweep of
// 40 ml has too few independent windows of that size, and chance decides.
#include "Filters/Register/Similarities/LocalFitSimilarity.h"
#include "Filters/Register/Similarities/SelfSimilarity.h"

#include <utility>

namespace brainshift
{
namespace
{
// Softer, the volume would fit the speckle by deformations that do not exist.
constexpr double SpeckleStiffness = 5.0;

// Costs of self-similarity differ more between positions than those of LC2.
constexpr float LocalFitWeight = 2.0f;

constexpr double LeastRivalGain = 0.03;
constexpr double MostScatterMm = 1.32; // README.md of the folder above has the figures

constexpr double SpacingMm = 1.0;
constexpr int KeptPositions = 3; // of a search from several starts

const Metric Self = thinSelfSimilarityWithEdges();
const Metric LC2 = linearFitWithGradients();

// LC2 explains how echoes rise by how edges do, if the beam is known. How loud an edge is, and on
// which side of it the echo is, depends on its tissues: so the second term has the bright sides.
LevelVolumes risesOf(LevelVolumes level)
{
  if (level.beam != glm::dvec3(0.0))
  {
    level.secondTerm = level.brightEdgeRise();
    std::vector<float> rise = level.edgeRise();
    level.reference.values = level.echoRise();
    level.rest.values = std::move(rise);
  }
  return level;
}

// The weighted mean of both costs. Its quicker part is self-similarity.
class BothCosts : public Comparison
{
public:
  BothCosts(LevelVolumes level, const Lattice& lattice)
    : First(Self.make(level, lattice))
    , Second(LC2.make(risesOf(std::move(level)), lattice))
  {
  }

  bool prepare() override
  {
    return this->First->prepare() && (this->Taken != Part::All || this->Second->prepare());
  }

  void take(Part part) override
  {
    this->Taken = part;
    this->First->take(part);
  }

  CostAndForces compare(const std::vector<glm::vec3>& displacements) override
  {
    CostAndForces result = this->First->compare(displacements);
    if (this->Taken != Part::All)
    {
      return result;
    }
    const CostAndForces more = this->Second->compare(displacements);
    constexpr float Weights = 1.0f + LocalFitWeight;
    result.cost = (result.cost + LocalFitWeight * more.cost) / Weights;
    for (std::size_t i = 0; i < result.forces.size(); ++i)
    {
      result.forces[i] = (result.forces[i] + LocalFitWeight * more.forces[i]) / Weights;
    }
    return result;
  }

  void restrictTo(const HalfSpace& half) override
  {
    this->First->restrictTo(half);
    this->Second->restrictTo(half);
  }

private:
  std::unique_ptr<Comparison> First;
  std::unique_ptr<Comparison> Second;
  Part Taken = Part::All;
};

const Metric Both{ Self.support, Self.bytesPerPoint + LC2.bytesPerPoint,
  [](LevelVolumes level, const Lattice& lattice) -> std::unique_ptr<Comparison> {
    return std::make_unique<BothCosts>(std::move(level), lattice);
  } };
}

Similarity describeUltrasound()
{
  Similarity result;
  result.name = "ultrasound";
  result.label = "Ultrasound";
  result.tooltip = "For a reference that is ultrasound. Compares self-similarity (SSC) of both "
                   "volumes and of their edges as the beam meets them, and LC2 of these. "
                   "The volume moves as a whole before it bends.";
  result.overlapOf = "the ultrasound fan";
  result.plan.levels = { { &Both, SpacingMm, 1.0, true, false, KeptPositions, 1.0, Part::Quickest },
    { &Both, SpacingMm, 1.0, true }, { &Both, SpacingMm } };
  result.plan.stiffness = SpeckleStiffness;
  result.plan.fan = FanLimits{};
  result.plan.check.halves = { &Both, SpacingMm, 1.0, true, false, 1, 1.0, Part::Quick };
  result.plan.check.rivalGain = LeastRivalGain; // LC2 has its say in the result already
  result.plan.check.scatterMm = MostScatterMm;
  return result;
}
}

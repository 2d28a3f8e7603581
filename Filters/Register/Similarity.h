// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief What a similarity is: how a refinement compares two volumes, on which levels, and what the
 *        user reads of it.
 *
 * Each similarity is one file in Similarities/. Panel, Python and pages read the list below.
 */
#ifndef BrainShift_Similarity_h
#define BrainShift_Similarity_h

#include "Common/Export.h"
#include "Filters/Deformation/Lattice.h"
#include "Filters/Register/LatticeRows.h"
#include "Filters/Register/Volume.h"

#include <glm/vec3.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace brainshift
{
// What a level of the pyramid compares, sample by sample.
//
// The volume stays at rest: a sample of it at x is compared with the reference at x + u(x). So
// nothing is inverted, and what describes the volume is computed once for each level.

/** The two volumes of one level, on the grid of the level. */
struct LevelVolumes
{
  Volume rest;
  Volume reference;
  Volume restWeights;      ///< 1 where the volume counts, else 0
  Volume referenceWeights; ///< 1 where the reference counts, else 0
};

/** The cost of a displacement, and its derivatives. */
struct CostAndForces
{
  double cost = 0.0;     ///< mean over all samples that count; 0: both agree; without samples: 1
  double samples = 0.0;  ///< how many of them have a partner in the reference
  double possible = 0.0; ///< how many could have one
  /** Minus half the derivative of `cost` by each control point, and half its lumped Hessian. */
  ControlForces forces;
};

/** The samples of a level: where they lie, how much they count and how freely they move. */
struct LevelSamples
{
  LevelSamples(const LevelVolumes& level, const Lattice& lattice);

  /** The samples of a row from the first to before the last that count. */
  struct Stretch
  {
    int first = 0;
    int last = 0;
  };

  LatticeRows rows;
  Volume referenceWeights;
  std::vector<float> weights;     ///< of the volume; 0: the sample does not count
  std::vector<float> freedom;     ///< 0 to 1, from the lattice's mask; empty: 1 everywhere
  std::vector<Stretch> stretches; ///< for each row
  glm::vec3 stepsPerMm{ 1.0f };

  double possible = 0.0; ///< how many samples count

  /** Finds `stretches` and `possible` from the weights. */
  void findStretches();

  /** Where a sample that counts is compared. */
  struct Place
  {
    std::size_t number = 0; ///< of the sample
    Taps taps;              ///< control points along x
    float weight = 0.0f;    ///< above 0
    float freedom = 1.0f;
    Neighbours at; ///< in the reference
  };

  /** Calls visit(place) for each sample of a row that counts and lies within the reference. */
  template <typename Visit>
  void visitStretch(const SampleRow& row, const Stretch& stretch, const Visit& visit) const
  {
    const Grid& grid = this->rows.samples();
    Place place;
    for (int i = stretch.first; i < stretch.last; ++i)
    {
      place.number = grid.offset(i, row.j, row.k);
      place.weight = this->weights[place.number];
      if (place.weight <= 0.0f)
      {
        continue;
      }
      const glm::vec3 position = this->rows.position(i, row.j, row.k);
      place.taps = this->rows.tapsAt(0, position.x);
      place.freedom = this->freedom.empty() ? 1.0f : this->freedom[place.number];
      place.at = neighboursOf(grid.dimensions,
        position + this->stepsPerMm * (place.freedom * LatticeRows::displacement(row, place.taps)));
      if (place.at.isInside)
      {
        visit(static_cast<const Place&>(place));
      }
    }
  }

  /** The numbers of a volume at the samples. `numbers` lie beside each other for each point. */
  std::vector<float> read(const std::vector<float>& values, int numbers) const;
};

/** Divides forces by the number of samples, so that levels compare. */
BRAINSHIFT_DEFORMATION_EXPORT CostAndForces averaged(
  const std::vector<double>& rowSums, const std::vector<double>& rowWeights, ControlForces forces);

/** The comparison of the two volumes of one level. */
class Comparison
{
public:
  virtual ~Comparison() = default;

  /** Does a part of the work before the first comparison. True once all is done. */
  virtual bool prepare() { return true; }

  /** Compares at displacements of the control points, mm along the grid's axes. */
  virtual CostAndForces compare(const std::vector<glm::vec3>& displacements) = 0;
};

/** A way to compare. */
struct Metric
{
  Support support;            ///< points around a position that its comparison depends on
  double bytesPerPoint = 0.0; ///< of a level's grid, while a comparison is made and used

  /**
   * @param lattice   over the volume's box; its mask says how freely tissue moves, its
   *                  displacements do not count
   */
  std::unique_ptr<Comparison> (*make)(LevelVolumes level, const Lattice& lattice) = nullptr;
};

/** How far a step goes, as a factor on the step of Gauss and Newton. */
struct StepGrowth
{
  double first = 1.0;
  double longest = 2.0;
  double growth = 1.2; ///< after each step that lowers the energy
};

/** One level of a refinement: what is compared there, and how finely. */
struct RefinementLevel
{
  const Metric* metric = nullptr;
  double spacingMm = 2.0; ///< of the samples; larger where the volume is coarser or too large
  double mostCost = 1.0;  ///< the level is left out if it begins with more: it might lead astray
  bool isRigid = false;   ///< the volume moves as a whole, in up to three times as many steps
};

/** How the fan of an ultrasound reference limits what is compared. */
struct FanLimits
{
  double marginMm = 10.0;      ///< tissue farther from the fan is not compared
  double mostSamples = 0.25e6; ///< inside the fan, so that a step stays short
};

/** What a refinement does. */
struct RefinementPlan
{
  std::vector<RefinementLevel> levels; ///< coarse to fine
  double stiffness = 1.0;              ///< factor on the stiffness
  std::optional<FanLimits> fan;        ///< set: the reference is ultrasound inside a fan
  StepGrowth bendGrowth;
  StepGrowth rigidGrowth{ 4.0, 16.0, 2.0 };
};

struct Similarity
{
  const char* name = "";                ///< in Python, lower case
  const char* label = "";               ///< in the panel
  const char* tooltip = "";             ///< when to choose it, and what it compares: sentences
  const char* overlapOf = "the volume"; ///< what the overlap of a result is a fraction of
  RefinementPlan plan;
};

/** All similarities. Their places are the numbers of the property Similarity; 0 is the default. */
BRAINSHIFT_DEFORMATION_EXPORT const std::vector<Similarity>& similarities();
}

#endif

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

#include "Filters/Deformation/Export.h"
#include "Filters/Deformation/Lattice.h"
#include "Filters/Register/LevelSamples.h"

#include <glm/vec3.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace brainshift
{
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

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief How well a bent volume agrees with a reference, and where each control point should go.
 */
#ifndef BrainShift_Similarity_h
#define BrainShift_Similarity_h

#include "Common/Export.h"
#include "Filters/Deformation/Lattice.h"
#include "Filters/Register/LevelSamples.h"

#include <glm/vec3.hpp>

#include <functional>
#include <vector>

namespace brainshift
{
/** What agreement means. */
enum class SimilarityKind
{
  SelfSimilarity = 0,    ///< self-similarity context: any contrast; the default
  LocalCorrelation = 1,  ///< squared local correlation: both volumes have the same contrast
  LinearCombination = 2, ///< LC2: the reference is ultrasound
};

/** Compares at displacements of the control points, mm along the grid's axes. */
using Similarity = std::function<Agreement(const std::vector<glm::vec3>& displacements)>;

/** Points around a position that its comparison depends on: the weights' reach. */
BRAINSHIFT_DEFORMATION_EXPORT Reach reachOf(SimilarityKind kind);

/**
 * @param lattice   over the volume's box; its mask says how freely tissue moves, its displacements
 *                  do not count
 */
BRAINSHIFT_DEFORMATION_EXPORT Similarity makeSimilarity(
  SimilarityKind kind, const LevelVolumes& level, const Lattice& lattice);

/** Bytes that a similarity takes for a level of so many points, while it is made and used. */
BRAINSHIFT_DEFORMATION_EXPORT double similarityBytes(SimilarityKind kind, double points);
}

#endif

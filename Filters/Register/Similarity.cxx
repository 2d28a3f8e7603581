// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Register/Similarity.h"

#include "Filters/Register/DescriptorSimilarity.h"
#include "Filters/Register/LocalFitSimilarity.h"
#include "Filters/Register/SelfSimilarity.h"

#include <memory>

namespace brainshift
{
namespace
{
template <typename Kind, typename... More>
Similarity made(const LevelVolumes& level, const Lattice& lattice, More... more)
{
  const auto kind = std::make_shared<Kind>(level, lattice, more...);
  return
    [kind](const std::vector<glm::vec3>& displacements) { return kind->compare(displacements); };
}
}

Reach reachOf(SimilarityKind kind)
{
  const Reach numbers = kind == SimilarityKind::SelfSimilarity ? SelfSimilarityReach : Reach{};
  // A position between points is read from all of them.
  return { numbers.along + 1, numbers.across + 1 };
}

Similarity makeSimilarity(SimilarityKind kind, const LevelVolumes& level, const Lattice& lattice)
{
  return kind == SimilarityKind::SelfSimilarity
    ? made<DescriptorSimilarity>(level, lattice)
    : made<LocalFitSimilarity>(level, lattice, kind == SimilarityKind::LinearCombination);
}

double similarityBytes(SimilarityKind kind, double points)
{
  return points *
    (kind == SimilarityKind::SelfSimilarity ? DescriptorSimilarity::BytesPerPoint
                                            : LocalFitSimilarity::BytesPerPoint);
}
}

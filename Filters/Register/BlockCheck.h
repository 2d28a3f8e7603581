// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Checks whether parts of the volume belong elsewhere: small blocks of it are searched for around
/// their position in the result.
///
/// A refinement by steps cannot pass a position that matches worse. Bone that stays beside a cortex
/// that sank may hold it, and other checks begin at the result and stay there as well. A block that
/// is compared at every position within a distance passes everything. One block may match elsewhere
/// by chance; blocks side by side that match much better at the same shift do not.
///
/// Method: block matching (Ourselin et al., Reconstructing a 3D structure from serial histological
/// sections, Image and Vision Computing 19, 2001).
#ifndef BrainShift_BlockCheck_h
#define BrainShift_BlockCheck_h

#include "Filters/Register/Similarity.h"

#include <limits>
#include <optional>

namespace brainshift
{
/** The blocks that belong elsewhere. */
struct Elsewhere
{
  double ml = 0.0;          ///< their volume; 0: there are none
  double mm = 0.0;          ///< how far from the result they match best, a mean
  glm::dvec3 middle{ 0.0 }; ///< of the blocks, mm, world, at rest
};

class BRAINSHIFT_DEFORMATION_EXPORT BlockCheck
{
public:
  /**
   * @param pair     both volumes, the reference in its position; lives longer than the check
   * @param result   the deformation, over the volume's box; lives longer than the check
   * @param by       what blocks are compared by
   */
  BlockCheck(const RegisteredPair& pair, const Lattice& result, const Descriptor& by);

  /** Does a part of the work. False: it is finished. */
  bool step();

  double done() const; ///< fraction, 0 to 1

  /** Once it is finished. */
  const Elsewhere& elsewhere() const { return this->Found; }

  /**
   * The motion of each control point that takes these blocks where they match best, and leaves the
   * others: means of the blocks around.
   */
  Controls motion() const;

private:
  struct Block
  {
    glm::ivec3 first{ 0 };    // point of the grid
    glm::ivec3 shift{ 0 };    // where it matches best, points from the result
    float here = 0.0f;        // its cost in the result, the least within a point
    float part = 0.0f;        // of its cost far off
    bool isKnown = false;     // it has enough tissue
    bool isCandidate = false; // it matches much better elsewhere
    bool isCounted = false;   // others beside it do so, too
  };

  struct TissuePoint
  {
    const float* numbers; // of the volume
    glm::ivec3 place;     // in the result, point of the grid
    std::ptrdiff_t at;    // the same, counted from the grid's first point
  };

  // The points of a block that are compared.
  struct Tissue
  {
    std::vector<TissuePoint> points;
    glm::ivec3 low; // of their places
    glm::ivec3 high;
  };

  void read();
  void findPlaces();
  void layBlocks();
  Tissue tissueOf(const Block& block) const;
  std::optional<float> costAt(const Tissue& tissue, const glm::ivec3& shift,
    float most = std::numeric_limits<float>::max()) const;
  void compare(Block& block) const;
  void findLeastPart();
  void search(Block& block) const;
  template <typename Visit>
  void visitSlab(int slab, const Visit& visit);
  int parts() const;
  glm::dvec3 shiftMm(const Block& block) const;
  glm::dvec3 middleOf(const Block& block) const;
  double weightOf(const Block& block) const;
  static void blur(Volume& ofBlocks);
  std::vector<std::size_t> connectedTo(std::size_t first, std::vector<char>& isSeen) const;
  void count();

  const RegisteredPair& Pair;
  const Lattice& Result;
  Descriptor By;
  Volume Rest;
  Volume Reference;
  Volume RestWeights;
  Volume ReferenceWeights;
  UnsetVector<float> RestNumbers;
  UnsetVector<float> ReferenceNumbers;
  std::vector<glm::ivec3> Places; // of each point's tissue in the result, points of the grid
  std::vector<Block> Blocks;      // x fastest
  float LeastPart = 0.0f;         // of a block that is searched
  glm::ivec3 Sides{ 0 };          // blocks along each axis
  int Part = 0;
  Elsewhere Found;
};
}

#endif

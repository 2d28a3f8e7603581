// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The presence map in the deformed frame, and the faces of its occupied bricks.
#ifndef BrainShift_DeformedPresence_h
#define BrainShift_DeformedPresence_h

#include "Representations/Gpu/Program.h"
#include "Representations/Skipping/BrickFaces.h"
#include "Representations/Skipping/RestPresence.h"

#include "vtkSmartPointer.h"
#include "vtkTextureObject.h" // for its smart pointer

class vtkOpenGLBufferObject;
class vtkOpenGLRenderWindow;
class vtkWindow;

namespace brainshift
{
/// The bricks that are requested, and the position of the offset field relative to them.
struct PresenceRequest
{
  glm::ivec3 restBricks{ 0 };    ///< Bricks of the rest volume, a side.
  glm::ivec3 first{ 0 };         ///< First brick of the deformed frame.
  glm::ivec3 count{ 0 };         ///< Bricks of the deformed frame, a side.
  glm::vec3 lowestVoxel{ 0.0f }; ///< The volume's box, voxels.
  glm::vec3 highestVoxel{ 0.0f };
  vtkTextureObject* offsets = nullptr; ///< Null: nothing is deformed.
  glm::vec3 voxelsFromOffset{ 1.0f };
  glm::vec3 voxelsFromLattice{ 1.0f }; ///< Of the fourth number of an offset.
  glm::vec3 nodesFromVoxel{ 1.0f };    ///< node = voxel * nodesFromVoxel + nodesFromVoxelShift
  glm::vec3 nodesFromVoxelShift{ 0.0f };
};

/// The presence map of one volume in one window.
class DeformedPresence
{
public:
  DeformedPresence();
  ~DeformedPresence();

  /// Uploads the summedVisibility of the rest volume. Call it anew after a change of the colour
  /// map.
  bool setVisibility(vtkOpenGLRenderWindow* window, const glm::ivec3& restBricks,
    std::vector<float>& summed, Counters& counters);

  /// Finds the occupied bricks and makes their faces, if anything changed. `changed`: the nodes
  /// whose offsets differ from the last update. After any other change all bricks are tested.
  bool update(vtkOpenGLRenderWindow* window, const PresenceRequest& request,
    const IndexBox& changed, Counters& counters);

  /// bricksToOccupied, as fractions of 255.
  vtkTextureObject* leaps() const { return this->Leaps; }

  /// Draws all faces with a program in use, whose attribute `corner` takes the corners in bricks.
  void drawFaces(int programHandle);

  /// Draws only the faces that look towards an eye. `eye`: see `facing`, from the volume's first
  /// voxel.
  void drawFaces(int programHandle, const glm::dvec4& eye);

  /// Whether an eye is outside the box of the occupied bricks. Then a ray meets front faces first.
  bool isOutside(const glm::dvec4& eye) const;

  /// Boxes that hold the occupied bricks (BrickFaces.h). Indices count from the request's first
  /// brick.
  const std::vector<IndexBox>& occupiedLayers() const { return this->OccupiedLayers; }

  /// All textures; some may be null.
  std::vector<vtkTextureObject*> textures() const
  {
    return { this->Summed, this->Map, this->Leaps, this->Blocks[0], this->Blocks[1] };
  }

  /// Bytes of the faces on the GPU.
  std::int64_t faceBytes() const;

  void releaseGraphicsResources(vtkWindow* window);

private:
  bool allocate(vtkOpenGLRenderWindow* window, const glm::ivec3& count);
  void setBricks(Program& program, const PresenceRequest& request);
  bool findBlocks(vtkOpenGLRenderWindow* window, const PresenceRequest& request,
    const IndexBox& box, Counters& counters);
  bool compute(vtkOpenGLRenderWindow* window, const PresenceRequest& request, const IndexBox& box,
    Counters& counters);
  bool readMap(const PresenceRequest& request, const IndexBox& box);
  bool makeLeaps(vtkOpenGLRenderWindow* window, const PresenceRequest& request);
  void makeFaces(const PresenceRequest& request);
  void drawRectangles(int programHandle, const std::vector<std::pair<int, int>>& ranges);
  glm::dvec4 fromFirstBrick(const glm::dvec4& eye) const;

  vtkSmartPointer<vtkTextureObject> Summed;
  vtkSmartPointer<vtkTextureObject> Map; // 1 for occupied bricks, 0 for others, of those asked last
  std::vector<std::uint8_t> Occupied;    // 1 for occupied bricks, 0 for others, of all bricks
  vtkSmartPointer<vtkTextureObject> Leaps;
  vtkSmartPointer<vtkTextureObject> Blocks[2]; // least, greatest offset in each, voxels
  vtkSmartPointer<vtkOpenGLBufferObject> Corners;
  PresenceRequest Known; // the request that Occupied answers
  bool AllNew = true;    // any brick may be occupied or empty now
  bool Failed = false;   // so Occupied is not of Known
  Program BlocksProgram;
  Program MapPrograms[2]; // [deformed]
  std::array<BrickFaces, 6> Faces;
  std::vector<IndexBox> OccupiedLayers;
  IndexBox OccupiedBox; // around them
};

// How far a ray may leap through empty bricks.
//
// Deakin and Knackstedt (2019) do so with volumes at rest; here it is done in the deformed frame.

constexpr int LongestLeap = 8; ///< Bricks. Longer leaps gain little.

/// For each of count.x * y * z bricks, x fastest: the Chebyshev distance to the nearest occupied
/// brick, in bricks, at most LongestLeap. 0 if the brick is occupied itself. `occupied`: 0 for
/// empty bricks.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT std::vector<std::uint8_t> bricksToOccupied(
  const std::vector<std::uint8_t>& occupied, const glm::ivec3& count);
}

#endif

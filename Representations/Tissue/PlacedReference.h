// SPDX-License-Identifier: BSD-3-Clause
// Where a reference, and the cavity drawn in it, lie to the bent volume: what a shader that
// compares is told, of rays and of slices.
#ifndef BrainShift_PlacedReference_h
#define BrainShift_PlacedReference_h

#include "Representations/Gpu/Counters.h"
#include "Filters/Attached/ReferenceVolume.h"
#include "Representations/Tissue/ScalarTexture.h"
#include "Representations/Scene/SceneGeometry.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <string>

class vtkMatrix4x4;
class vtkOpenGLRenderWindow;
class vtkTextureObject;
class vtkWindow;

namespace brainshift
{
class Program;

struct PlacedReference
{
  vtkTextureObject* scalars = nullptr;    // null: nothing is compared
  glm::dmat4 referenceFromTexture{ 1.0 }; // its texture coordinates from the volume's
  glm::dvec3 low{ 0.0 };                  // its box, in its texture coordinates
  glm::dvec3 high{ 1.0 };
};

struct PlacedCavity
{
  vtkTextureObject* voxels = nullptr; // null: none
  glm::dmat4 cavityFromTexture{ 1.0 };
  double least = 0.5; // stored
};

// Where the bent volume's texture lies. `actor`: moves all of them.
struct VolumePlace
{
  glm::dmat4 worldFromTexture{ 1.0 };
  vtkMatrix4x4* actor = nullptr;

  // Texture coordinates of another grid from the volume's.
  glm::dmat4 otherFromTexture(const Grid& grid, const ValueLayout& layout) const;
};

// A cavity in a window.
class CavityTexture
{
public:
  // Makes it current and says where it lies; nothing without voxels. False, with one sentence in
  // `problem`, if this GPU cannot.
  bool update(vtkOpenGLRenderWindow* window, const PlacedVoxels& cavity, const VolumePlace& volume,
    PlacedCavity& placed, Counters& counters, std::string& problem);

  vtkTextureObject* texture() const { return this->Voxels.texture(); }
  void releaseGraphicsResources(vtkWindow* window);

private:
  ScalarTexture Voxels;
};

void setReferencePlace(Program& program, const PlacedReference& reference);
void setCavityUniforms(Program& program, const PlacedCavity& cavity);
}

#endif

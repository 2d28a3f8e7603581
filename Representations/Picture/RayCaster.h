// SPDX-License-Identifier: BSD-3-Clause
// Casts the rays into images of its own, which are then laid over the scene.
#ifndef BrainShift_RayCaster_h
#define BrainShift_RayCaster_h

#include "Representations/Picture/CastImages.h"
#include "Representations/Gpu/Counters.h"
#include "Filters/Deformation/FieldChange.h"
#include "Representations/Scene/ImageArea.h"
#include "Representations/Gpu/Program.h"
#include "Representations/Picture/RayCastComparison.h"
#include "Representations/Picture/RayCastLights.h"
#include "Representations/Picture/RayCastOptions.h"

#include "vtkSmartPointer.h"

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <map>
#include <vector>

class vtkOpenGLRenderWindow;
class vtkRenderer;
class vtkTextureObject;
class vtkVolumeProperty;
class vtkWindow;

namespace brainshift
{
class DeformedPresence;

// Everything one image depends on. Texture coordinates are the scalar texture's.
struct RayCastScene
{
  glm::ivec2 size{ 0 }; // pixels
  PixelBox shown;       // the part of the image that is cast: what can show something, or less,
  PixelBox turned{ glm::ivec2(-1 << 20), glm::ivec2(1 << 20) }; // see PixelPart
  glm::dmat4 clipFromWorld{ 1.0 };
  glm::dmat4 worldFromTexture{ 1.0 };
  glm::dvec3 mmFromTexture{ 1.0 }; // along the volume's axes, before an actor's scale
  glm::dvec3 spaceLow{ 0.0 };      // part of the deformed frame tissue can reach
  glm::dvec3 spaceHigh{ 1.0 };
  SlabHull moved; // where tissue may have moved, in lattice coordinates, which are
  glm::dvec3 latticeFromTexture{ 1.0 }; // texture * latticeFromTexture + latticeOfTextureZero
  glm::dvec3 latticeOfTextureZero{ 0.0 };
  glm::dvec3 volumeLow{ 0.0 }; // the volume's box in the rest frame
  glm::dvec3 volumeHigh{ 1.0 };
  glm::dvec3 voxel{ 1.0 };            // one voxel, texture coordinates
  glm::dvec3 textureFromBrick{ 1.0 }; // presence map: scale and shift
  glm::dvec3 textureOfBrickZero{ 0.0 };
  glm::dvec3 firstBrick{ 0.0 };       // of the presence map
  glm::dvec3 fieldFromTexture{ 1.0 }; // offset field's texture coordinates: scale and shift
  glm::dvec3 fieldFromTextureShift{ 0.0 };
  glm::dvec3 fieldTexel{ 1.0 }; // step for derivatives, the offset field's coordinates
  double stepMm = 1.0;
  int stepDoublings = 0; // the colour map's opacities hold for a step this often halved
  glm::dvec2 transferFromScalar{ 1.0, 0.0 }; // stored scalar to transfer coordinate
  glm::dvec2 visibleScalars{ 0.0, 1.0 };     // stored scalars beyond which nothing is visible
  glm::dvec4 material{ 0.0, 1.0, 0.0, 1.0 }; // ambient, diffuse, specular, specular power
  RayCastLights lights;
  RayCastOptions options;
  RayCastComparison comparison;
  bool shaded = false;
  bool opaqueTissue = false; // at some value a step hides what is behind
  bool skipping = true;
  bool jitter = false;       // rays start at different shares of a step
  bool countSamples = false; // counters learn of samples taken and skipped; Composite only
  bool tile = false;         // the image is a part of a picture larger than the window
  glm::dvec2 hitFromShare{ 1.0, 0.0 }; // what is told of a hit, from its share of the ray

  vtkTextureObject* scalars = nullptr;
  vtkTextureObject* offsets = nullptr; // null: the volume carries no deformation
  vtkTextureObject* normals = nullptr; // null: gradients on the fly
  vtkTextureObject* transfer = nullptr;
  vtkTextureObject* transferSums = nullptr; // of a steep map, else null
  DeformedPresence* presence = nullptr;
  vtkTextureObject* sceneDepth = nullptr;
  glm::vec2 depthFromShare{ 1.0f }; // sceneDepth's coordinates from the share of the image
  glm::vec2 depthOfShareZero{ 0.0f };

  bool raysEndSoon() const { return this->opaqueTissue && this->options.blend == Blend::Composite; }
};

// What tissue.glsl and field.glsl need; the latter where the scene has offsets.
void setTissueUniforms(Program& program, const RayCastScene& scene);
void setFieldUniforms(Program& program, const RayCastScene& scene);

class RayCaster
{
public:
  RayCaster();
  ~RayCaster();

  // Draws the image. False if a shader does not compile or the image cannot be made.
  bool cast(vtkOpenGLRenderWindow* window, const RayCastScene& scene, Counters& counters);

  // Draws the scene's part of an image that is held anew, with the camera it was drawn with. The
  // rest of the image stays.
  bool castPart(vtkOpenGLRenderWindow* window, const RayCastScene& scene, Counters& counters);

  CastImages& images() { return this->Images; }
  const CastImages& images() const { return this->Images; }

  void releaseGraphicsResources(vtkWindow* window);

private:
  bool draw(
    vtkOpenGLRenderWindow* window, const RayCastScene& scene, bool part, Counters& counters);
  bool findSpans(vtkOpenGLRenderWindow* window, const RayCastScene& scene, Counters& counters);
  void setUniforms(Program& program, const RayCastScene& scene);

  CastImages Images;
  std::map<RayCastVariant, Program> CastPrograms; // those drawn with so far
  Program SpansProgram;
};
}

#endif

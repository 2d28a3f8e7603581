// SPDX-License-Identifier: BSD-3-Clause
// Casts the rays into an image of its own and lays that image over the scene.
#ifndef BrainShift_RayCaster_h
#define BrainShift_RayCaster_h

#include "Counters.h"
#include "FieldChange.h"
#include "FirstHits.h"
#include "ImageArea.h"
#include "Program.h"
#include "RayCastComparison.h"
#include "RayCastLights.h"
#include "RayCastOptions.h"

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
  glm::ivec2 size{ 0 };      // pixels
  glm::ivec2 shownLow{ 0 };  // the part of the image that can show something: first pixel,
  glm::ivec2 shownHigh{ 0 }; // and one past the last
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

  // Blends the image over a rectangle (pixels) of the framebuffer that is bound.
  bool composite(vtkOpenGLRenderWindow* window, const glm::ivec2& origin, const glm::ivec2& size,
    Counters& counters);

  // What the last whole image shows at a place counted from its lower left corner to 1: first hit
  // (mm, world) and its distance from the near plane (mm). False where no surface was hit or
  // nothing was cast yet.
  bool hitAt(vtkOpenGLRenderWindow* window, const glm::dvec2& place, glm::dvec4& hit);

  // What hitAt reads, texel by texel. Null if nothing was cast yet.
  const FirstHits* hits() const { return this->castHits(false); }

  // The same of the last image, whole or a tile.
  const FirstHits* drawnHits() const { return this->castHits(this->DrewTile); }

  // All textures, some of which may be null.
  std::vector<vtkTextureObject*> textures() const
  {
    return { this->Image, this->Hits[false].texture, this->Hits[true].texture, this->Count,
      this->Spans };
  }

  void releaseGraphicsResources(vtkWindow* window);

private:
  const FirstHits* castHits(bool tile) const
  {
    return this->Hits[tile].texture ? &this->Hits[tile] : nullptr;
  }
  bool prepareImages(vtkOpenGLRenderWindow* window, const RayCastScene& scene);
  bool findSpans(vtkOpenGLRenderWindow* window, const RayCastScene& scene, Counters& counters);
  void setUniforms(Program& program, const RayCastScene& scene);

  bool prepareCount(vtkOpenGLRenderWindow* window, const glm::ivec2& size);
  void readCount(Counters& counters);
  void clearStaleHits(const RayCastScene& scene);

  // What was cast last of a picture: first pixel, one past the last.
  struct Part
  {
    glm::ivec2 low{ 0 };
    glm::ivec2 high{ 0 };
  };
  bool DrewTile = false;
  ImageArea Area; // of Image, Spans and Count, and the Hits drawn last
  Part ImagePart;
  Part HitsPart[2];                        // elsewhere Hits tell of none
  FirstHits Hits[2];                       // [tile]
  vtkSmartPointer<vtkTextureObject> Image; // colour times opacity, opacity
  vtkSmartPointer<vtkTextureObject> Count; // samples taken and skipped; null unless asked for
  vtkSmartPointer<vtkTextureObject> Spans; // of a ray: share before and behind occupied bricks
  std::map<RayCastVariant, Program> CastPrograms; // those drawn with so far
  Program SpansProgram;
  Program CompositeProgram;
};
}

#endif

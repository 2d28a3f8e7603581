// SPDX-License-Identifier: BSD-3-Clause
// The images that rays are cast into, and what of them holds.
#ifndef BrainShift_CastImages_h
#define BrainShift_CastImages_h

#include "Representations/Gpu/Counters.h"
#include "Representations/Scene/FirstHits.h"
#include "Representations/Scene/ImageArea.h"
#include "Representations/Gpu/Program.h"

#include "vtkSmartPointer.h"

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <vector>

class vtkOpenGLRenderWindow;
class vtkTextureObject;
class vtkWindow;

namespace brainshift
{
class ImageScope;
struct RayCastScene;

class CastImages
{
public:
  // Makes images for the scene. False if the GPU refuses.
  bool prepare(vtkOpenGLRenderWindow* window, const RayCastScene& scene);
  bool prepareCount(vtkOpenGLRenderWindow* window);

  // Lets the scene be drawn into them: a picture of its own, or a part of the one that is held.
  // `counted`: with samples told.
  void attach(ImageScope& scope, const RayCastScene& scene, bool part, bool counted);

  // Draws the pixels of a part, with a program whose vertex stage is outline.vert.glsl.
  void drawPart(Program& program, const PixelPart& part) const;

  // Adds up what was told of the samples.
  void readCount(Counters& counters);

  // Whether they hold a whole picture of the scene's size.
  bool hold(const RayCastScene& scene) const;

  // Whether there is room for what is shown.
  bool haveRoom(const PixelBox& shown) const { return contains(this->Area.box(), shown); }

  // Makes room for what is shown and keeps the picture that is held.
  bool grow(vtkOpenGLRenderWindow* window, const RayCastScene& scene, Counters& counters);

  // What hits are told in, for the scene's part to be cast into the picture that is held.
  glm::dvec2 hitFromShare(const RayCastScene& scene) const;

  // Replaces a part of the picture that is held by that of another one, smaller or not.
  bool enlarge(vtkOpenGLRenderWindow* window, const CastImages& other, const PixelPart& part,
    Counters& counters);

  // Blends the picture over a rectangle (pixels) of the framebuffer that is bound.
  bool composite(vtkOpenGLRenderWindow* window, const glm::ivec2& origin, const glm::ivec2& size,
    Counters& counters);

  // What the last whole picture shows at a place counted from its lower left corner to 1: first hit
  // (mm, world) and its distance from the near plane (mm). False where no surface was hit or
  // nothing was cast yet.
  bool hitAt(vtkOpenGLRenderWindow* window, const glm::dvec2& place, glm::dvec4& hit);

  // What hitAt reads, texel by texel. Null if nothing was cast yet.
  const FirstHits* hits() const { return this->castHits(false); }

  // The same of the last picture, whole or a tile.
  const FirstHits* drawnHits() const { return this->castHits(this->DrewTile); }

  const ImageArea& area() const { return this->Area; }
  const PixelBox& shown() const { return this->Part; } // the pixels that may show something
  vtkTextureObject* spans() const { return this->Spans; }

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
  void clearStale(const RayCastScene& scene);
  void clear(unsigned int target);

  bool DrewTile = false;
  ImageArea Area;                          // of Image, Spans and Count, and the Hits drawn last
  PixelBox Part;                           // elsewhere Image is empty,
  PixelBox HitsPart[2];                    // and Hits tell of none
  FirstHits Hits[2];                       // [tile]
  vtkSmartPointer<vtkTextureObject> Image; // colour times opacity, opacity
  vtkSmartPointer<vtkTextureObject> Count; // samples taken and skipped; null unless asked for
  vtkSmartPointer<vtkTextureObject> Spans; // of a ray: share before and behind occupied bricks
  Program CompositeProgram;
  Program EnlargeProgram;
};
}

#endif

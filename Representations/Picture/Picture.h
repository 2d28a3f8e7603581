// SPDX-License-Identifier: BSD-3-Clause
// A window's picture of a volume. What a stroke leaves as it was is not cast again: only the pixels
// behind which tissue moved are, so that these can have more of a moving frame's time.
#ifndef BrainShift_Picture_h
#define BrainShift_Picture_h

#include "Representations/Gpu/Counters.h"
#include "Representations/Field/FieldTexture.h"
#include "Representations/Picture/MovingQuality.h"
#include "Representations/Picture/PictureStamp.h"
#include "Representations/Picture/RayCaster.h"
#include "Representations/Scene/SceneDepth.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <vector>

class vtkRenderer;
class vtkTextureObject;
class vtkVolume;
class vtkWindow;

namespace brainshift
{
// How a picture is wanted.
struct PictureWish
{
  bool adaptive = true;   // fewer pixels and longer steps while the window moves
  bool keep = false;      // what would come out the same is not cast at all
  double rate = 0.0;      // pictures a second that the window wants
  glm::ivec2 origin{ 0 }; // of the picture in the window, pixels

  unsigned long long settingsTime = 0; // when the mapper was set up otherwise
};

class Picture
{
public:
  // The time of a picture runs from here,
  void begin() { this->Pace.beginPicture(); }

  // The offset field has changed there since the last picture.
  void bend(const FieldTexture::Bent& bent);

  // The next picture is cast whole.
  void forget() { this->Stamp.forget(); }

  // Casts what has changed of a scene of full size and quality. False if a shader does not compile
  // or an image cannot be made.
  bool cast(vtkRenderer* renderer, vtkVolume* volume, const PictureWish& wish, RayCastScene& scene,
    Counters& counters);

  // to here: all of it is told to OpenGL.
  void end() { this->Pace.endPicture(); }

  CastImages& images() { return this->Whole.images(); }
  const CastImages& images() const { return this->Whole.images(); }
  std::vector<vtkTextureObject*> textures() const;

  void releaseGraphicsResources(vtkWindow* window);

private:
  bool canKeep(PictureStamp::Change change, const PictureWish& wish, const RayCastScene& scene);
  bool castAll(vtkOpenGLRenderWindow* window, const PictureWish& wish, RayCastScene& scene,
    Counters& counters);
  bool castChanged(vtkOpenGLRenderWindow* window, const PictureWish& wish, RayCastScene& scene,
    Counters& counters);
  bool castRoughly(vtkOpenGLRenderWindow* window, const PictureWish& wish,
    const MovingQuality& quality, const RayCastScene& scene, const PixelPart& part,
    Counters& counters);
  PixelPart changedPart(bool moving, const RayCastScene& scene) const;
  bool isBent() const { return this->Bent.all || !this->Bent.corners.empty(); }
  MovingQuality qualityFor(const PictureWish& wish, const PixelPart& part) const;
  template <typename Cast>
  bool measure(vtkOpenGLRenderWindow* window, const PictureWish& wish, const RayCastScene& scene,
    const Cast& cast);

  RayCaster Whole;
  RayCaster Rough;             // parts with fewer pixels, on their way into Whole
  SceneDepth Depth;            // of what is drawn already
  PictureStamp Stamp;          // of what Whole holds
  FieldTexture::Bent Bent;     // what changed since
  glm::dvec3 SpaceLow{ 0.0 };  // what tissue could reach in any part of what Whole holds,
  glm::dvec3 SpaceHigh{ 0.0 }; // texture coordinates
  bool Mixed = false;          // parts of what Whole holds had rays that began elsewhere
  PixelPart RoughPart;         // of what Whole holds: not at full quality
  WindowPace Pace;
  double SecondsPerPixel = 0.0; // of the last one cast, with the usual step; 0: none yet
};
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Picture/Picture.h"

#include "vtkNew.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkTextureObject.h"
#include "vtkTimerLog.h"

#include <glm/common.hpp>

namespace brainshift
{
namespace
{
constexpr double FewPixels = 2000.0; // whose time is that of all else

bool moves(const PictureWish& wish)
{
  return wish.adaptive && isMoving(wish.rate);
}

// Finds what of the scene's image can show something.
void placePixels(RayCastScene& scene)
{
  scene.shown = { glm::ivec2(0), scene.size };
  if (scene.skipping)
  {
    placeComparedPixels(scene);
  }
}

// Fewer pixels and longer steps.
void adapt(const MovingQuality& quality, RayCastScene& scene)
{
  scene.stepDoublings = scene.options.blend == Blend::Composite ? quality.stepDoublings : 0;
  scene.stepMm *= 1 << scene.stepDoublings;
  scene.size = glm::max(scene.size / quality.imageScale, glm::ivec2(1));
  placePixels(scene);
}

// A part of a picture in a smaller image of it, with a pixel more to every side for the filter.
PixelPart reduced(const PixelPart& part, const glm::ivec2& size, const glm::ivec2& smaller)
{
  const glm::dvec2 scale = glm::dvec2(smaller) / glm::dvec2(size);
  const PixelBox box{ glm::ivec2(glm::floor(glm::dvec2(part.box.low) * scale)) - 1,
    glm::ivec2(glm::ceil(glm::dvec2(part.box.high) * scale)) + 1 };
  // Sizes are rounded, so that both axes are reduced a little differently.
  const double least = glm::min(scale.x, scale.y);
  const glm::dvec2 rounded = glm::abs(scale - least) * glm::dvec2(size);
  const double more = 3.0 + rounded.x + rounded.y;
  return { overlap(box, { glm::ivec2(0), smaller }),
    { glm::ivec2(glm::floor(glm::dvec2(part.turned.low) * least - more)),
      glm::ivec2(glm::ceil(glm::dvec2(part.turned.high) * least + more)) } };
}

void setPart(const PixelPart& part, RayCastScene& scene)
{
  scene.shown = part.box;
  scene.turned = part.turned;
}
}

void Picture::bend(const FieldTexture::Bent& bent)
{
  this->Bent.all = this->Bent.all || bent.all;
  this->Bent.corners.insert(this->Bent.corners.end(), bent.corners.begin(), bent.corners.end());
}

bool Picture::cast(vtkRenderer* renderer, vtkVolume* volume, const PictureWish& wish,
  RayCastScene& scene, Counters& counters)
{
  auto window = vtkOpenGLRenderWindow::SafeDownCast(renderer->GetRenderWindow());
  placePixels(scene);
  const PictureStamp::Change change =
    this->Stamp.change(renderer, volume, wish.settingsTime, scene, counters);
  const bool kept = this->canKeep(change, wish, scene);
  counters.imageScale = 1;
  const bool done = kept ? this->castChanged(window, wish, scene, counters)
                         : this->castAll(window, wish, scene, counters);
  if (!done)
  {
    this->forget();
  }
  if (!moves(wish))
  {
    this->Rough.images().releaseGraphicsResources(window);
  }
  return done;
}

// Whether something of the last picture can stay.
bool Picture::canKeep(
  PictureStamp::Change change, const PictureWish& wish, const RayCastScene& scene)
{
  if (scene.countSamples || !this->images().hold(scene) ||
    (!this->isBent() && this->RoughPart.empty() && !wish.keep))
  {
    return false;
  }
  switch (change)
  {
    case PictureStamp::Nothing:
      return moves(wish) || !this->Mixed;
    case PictureStamp::Bending:
      return !scene.comparison.reference && (moves(wish) || !this->Mixed);
    case PictureStamp::Reaching:
      // Samples lie elsewhere on their rays: as different as a rough picture is anyway.
      this->Mixed = true;
      return !scene.comparison.reference && moves(wish);
    default:
      return false;
  }
}

bool Picture::castAll(
  vtkOpenGLRenderWindow* window, const PictureWish& wish, RayCastScene& scene, Counters& counters)
{
  const glm::ivec2 size = scene.size;
  const MovingQuality quality = this->qualityFor(wish, partOf(scene.shown));
  counters.imageScale = quality.imageScale;
  adapt(quality, scene);
  scene.jitter = moves(wish);
  this->Depth.captureBehind(window, wish.origin, size, scene);
  const bool cast =
    this->measure(window, wish, scene, [&] { return this->Whole.cast(window, scene, counters); });
  this->Bent = FieldTexture::Bent();
  this->SpaceLow = scene.spaceLow;
  this->SpaceHigh = scene.spaceHigh;
  this->Mixed = false;
  this->RoughPart = scene.jitter ? partOf({ glm::ivec2(0), size }) : PixelPart();
  return cast;
}

PixelPart Picture::changedPart(bool moving, const RayCastScene& scene) const
{
  const PixelBox shown = enclosing(scene.shown, this->images().shown());
  PixelPart part = this->Bent.all
    ? partOf(shown)
    : pixelsBetween(this->Bent.corners, this->SpaceLow, this->SpaceHigh, scene);
  if (!moving)
  {
    part = enclosing(part, this->RoughPart);
  }
  part.box = overlap(part.box, shown);
  // What the picture's edge leaves of an octagon may be no box but have as few corners, which
  // CastImages draws as one.
  return isDrawnAsBox(part) ? partOf(part.box) : part;
}

bool Picture::castChanged(
  vtkOpenGLRenderWindow* window, const PictureWish& wish, RayCastScene& scene, Counters& counters)
{
  const bool moving = moves(wish);
  CastImages& held = this->images();
  if (!held.haveRoom(scene.shown) && !held.grow(window, scene, counters))
  {
    return false;
  }
  this->SpaceLow = glm::min(this->SpaceLow, scene.spaceLow);
  this->SpaceHigh = glm::max(this->SpaceHigh, scene.spaceHigh);
  const PixelPart part = this->changedPart(moving, scene);
  MovingQuality quality = this->qualityFor(wish, part);
  quality.stepDoublings = 0; // beside what stays, surfaces would look grainy
  bool done = true;
  if (!part.empty() && !quality.isFull())
  {
    done = this->castRoughly(window, wish, quality, scene, part, counters);
    this->RoughPart = enclosing(this->RoughPart, part);
  }
  else if (!part.empty())
  {
    setPart(part, scene);
    this->Depth.captureBehind(window, wish.origin, scene.size, scene);
    done = this->measure(
      window, wish, scene, [&] { return this->Whole.castPart(window, scene, counters); });
  }
  if (!moving)
  {
    this->RoughPart = PixelPart();
  }
  this->Bent = FieldTexture::Bent();
  return done;
}

bool Picture::castRoughly(vtkOpenGLRenderWindow* window, const PictureWish& wish,
  const MovingQuality& quality, const RayCastScene& scene, const PixelPart& part,
  Counters& counters)
{
  counters.imageScale = quality.imageScale;
  RayCastScene rough = scene;
  adapt(quality, rough);
  setPart(reduced(part, scene.size, rough.size), rough);
  rough.jitter = true;
  rough.hitFromShare = this->images().hitFromShare(scene);
  this->Depth.captureBehind(window, wish.origin, scene.size, rough);
  return this->measure(
           window, wish, rough, [&] { return this->Rough.cast(window, rough, counters); }) &&
    this->images().enlarge(window, this->Rough.images(), part, counters);
}

MovingQuality Picture::qualityFor(const PictureWish& wish, const PixelPart& part) const
{
  return moves(wish)
    ? movingQuality(this->SecondsPerPixel * pixelsIn(part),
        allowedSeconds(wish.rate, this->Pace.windowSeconds(), this->Pace.spentSeconds()))
    : MovingQuality();
}

template <typename Cast>
bool Picture::measure(vtkOpenGLRenderWindow* window, const PictureWish& wish,
  const RayCastScene& scene, const Cast& cast)
{
  vtkNew<vtkTimerLog> timer;
  timer->StartTimer();
  if (!cast())
  {
    return false;
  }
  const double pixels = pixelsIn({ scene.shown, scene.turned });
  if (wish.adaptive && (pixels >= FewPixels || (pixels > 0.0 && this->SecondsPerPixel == 0.0)))
  {
    window->WaitForCompletion(); // else the time is that of the commands, not of the image
    timer->StopTimer();
    this->SecondsPerPixel = timer->GetElapsedTime() * (1 << scene.stepDoublings) / pixels;
  }
  return true;
}

std::vector<vtkTextureObject*> Picture::textures() const
{
  std::vector<vtkTextureObject*> all = this->Whole.images().textures();
  const std::vector<vtkTextureObject*> rough = this->Rough.images().textures();
  all.insert(all.end(), rough.begin(), rough.end());
  all.push_back(this->Depth.copied());
  return all;
}

void Picture::releaseGraphicsResources(vtkWindow* window)
{
  this->Whole.releaseGraphicsResources(window);
  this->Rough.releaseGraphicsResources(window);
  this->Depth.releaseGraphicsResources(window);
  this->Stamp.forget();
}
}

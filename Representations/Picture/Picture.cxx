// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Picture/Picture.h"

#include "Representations/Scene/OverVolumes.h"

#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkProp.h"
#include "vtkPropCollection.h"
#include "vtkRenderer.h"
#include "vtkTimerLog.h"
#include "vtkVolume.h"
#include "vtkVolumeProperty.h"

#include <glm/gtc/matrix_access.hpp>

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace brainshift
{
namespace
{
using Numbers = std::vector<double>;

template <typename Value>
void add(Numbers& numbers, const std::vector<Value>& values)
{
  numbers.push_back(static_cast<double>(values.size()));
  numbers.insert(numbers.end(), values.begin(), values.end());
}

void add(Numbers& numbers, const glm::dmat4& matrix)
{
  numbers.insert(numbers.end(), &matrix[0][0], &matrix[0][0] + 16);
}

// Whether the camera's clipping planes leave all of the volume.
bool isUncut(const RayCastScene& scene)
{
  const glm::dmat4 clipFromTexture = scene.frame.clipFromWorld * scene.frame.worldFromTexture;
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::dvec3 side(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
    const glm::dvec4 clip =
      clipFromTexture * glm::dvec4(glm::mix(scene.cuts.spaceLow, scene.cuts.spaceHigh, side), 1.0);
    if (std::abs(clip.z) > clip.w)
    {
      return false;
    }
  }
  return true;
}

// The camera's clipping planes follow everything in the scene, even traced points. They count only
// if they cut the volume.
void addCamera(Numbers& numbers, const RayCastScene& scene)
{
  glm::dmat4 clipFromWorld = scene.frame.clipFromWorld;
  if (isUncut(scene))
  {
    clipFromWorld = glm::row(clipFromWorld, 2, glm::dvec4(0.0));
  }
  add(numbers, clipFromWorld);
}

// Where the picture is seen from, and in what light.
void addView(Numbers& numbers, const RayCastScene& scene)
{
  addCamera(numbers, scene);
  add(numbers, scene.frame.worldFromTexture);
  const SceneField& field = scene.field;
  for (int axis = 0; axis < 3; ++axis)
  {
    numbers.insert(
      numbers.end(), { field.latticeFromTexture[axis], field.latticeOfTextureZero[axis] });
  }
  const SceneImage& image = scene.image;
  const SceneLights& lights = scene.frame.lights;
  numbers.insert(numbers.end(),
    { double(field.offsets != nullptr), double(image.size.x), double(image.size.y),
      scene.tissue.stepMm, double(image.skips), double(image.countSamples),
      double(scene.frame.tile), double(lights.headlight) });
  add(numbers, lights.position);
  add(numbers, lights.color);
  add(numbers, lights.specular);
  const SceneComparison& comparison = scene.comparison;
  numbers.push_back(scene.tissue.scalars->GetHandle()); // of the volume or of its reference
  if (comparison.reference)
  {
    add(numbers, comparison.reference->frame.worldFromTexture);
    numbers.push_back(comparison.reference->tissue.scalars->GetHandle());
    numbers.push_back(comparison.cavity.voxels ? comparison.cavity.voxels->GetHandle() : 0);
    add(numbers, comparison.cavity.cavityFromTexture);
  }
}

void add(Numbers& numbers, std::initializer_list<std::int64_t> counts)
{
  for (const std::int64_t count : counts)
  {
    numbers.push_back(static_cast<double>(count));
  }
}

// Everything else in the scene.
void addOtherProps(Numbers& numbers, const DrawnVolume& drawn)
{
  vtkPropCollection* props = drawn.renderer->GetViewProps();
  vtkCollectionSimpleIterator at;
  props->InitTraversal(at);
  while (vtkProp* prop = props->GetNextProp(at))
  {
    if (prop == drawn.volume || OverVolumes::SafeDownCast(prop))
    {
      continue;
    }
    // What is nowhere changes often: ParaView's selections, for example.
    const double* bounds = prop->GetVisibility() ? prop->GetBounds() : nullptr;
    const bool seen = bounds && vtkMath::AreBoundsInitialized(bounds);
    numbers.push_back(seen ? static_cast<double>(prop->GetRedrawMTime()) : 0.0);
  }
}

// The volume as the user chose it, and the view of it.
void addChosen(Numbers& numbers, const DrawnVolume& drawn, unsigned long long settingsTime,
  const RayCastScene& scene, const Counters& counters)
{
  addView(numbers, scene);
  add(numbers,
    { counters.volumeUploads, counters.transferUploads, counters.segmentUploads,
      counters.evidenceUploads, scene.evidence.deviations ? 1 : 0 });
  for (const PlacedFractions& mask : { scene.resection.removed, scene.resection.tumour })
  {
    add(numbers, mask.ownFromTexture);
    numbers.push_back(mask.fractions ? mask.fractions->GetHandle() : 0);
  }
  add(numbers, scene.cuts.clipPlanes);
  add(numbers, scene.blending.isovalues);
  for (int i = 0; i < 4; ++i)
  {
    numbers.push_back(scene.blending.slicePlane[i]);
  }
  // Not the volume's own time: ParaView poses it for each picture anew.
  numbers.push_back(static_cast<double>(settingsTime));
  numbers.push_back(static_cast<double>(drawn.volume->GetProperty()->GetMTime()));
}

// A camera's matrix rounds differently when its clipping planes move. Counts and times have far
// fewer than the 12 digits that are compared.
bool same(const Numbers& a, const Numbers& b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
    [](double one, double other) { return std::abs(one - other) <= 1e-12 * std::abs(one); });
}
}

PictureStamp::Change PictureStamp::change(const DrawnVolume& drawn, unsigned long long settingsTime,
  const RayCastScene& scene, const Counters& counters)
{
  Numbers now;
  addChosen(now, drawn, settingsTime, scene, counters);
  addOtherProps(now, drawn);
  now.push_back(scene.bricks.pages ? static_cast<double>(scene.bricks.changes) : -1.0);
  Numbers bending;
  add(bending,
    { counters.latticeUploads, counters.texelsRefined, counters.presenceUpdates,
      counters.bytesUploaded, static_cast<std::int64_t>(drawn.volume->GetRedrawMTime()) });
  Numbers space;
  for (int axis = 0; axis < 3; ++axis)
  {
    space.insert(space.end(),
      { scene.cuts.spaceLow[axis], scene.cuts.spaceHigh[axis], scene.field.texel[axis] });
  }
  const bool sameView = same(now, this->Last);
  const bool sameSpace = space == this->LastSpace;
  const bool sameBending = bending == this->LastBending;
  this->Last = std::move(now);
  this->LastSpace = std::move(space);
  this->LastBending = std::move(bending);
  return !sameView ? Anything : !sameSpace ? Reaching : sameBending ? Nothing : Bending;
}

ViewStamp::Change ViewStamp::change(const DrawnVolume& drawn, unsigned long long settingsTime,
  const RayCastScene& scene, const Counters& counters)
{
  Numbers view;
  addChosen(view, drawn, settingsTime, scene, counters);
  // Not how far its field is computed: bricks that come change that.
  view.push_back(static_cast<double>(counters.latticeUploads));
  Numbers others;
  addOtherProps(others, drawn);
  const bool sameView = same(view, this->Last);
  const bool sameOthers = same(others, this->LastOthers);
  this->Last = std::move(view);
  this->LastOthers = std::move(others);
  return !sameView ? View : sameOthers ? Nothing : Others;
}

namespace
{
constexpr double FewPixels = 2000.0; // below, everything else takes most of the time

// Finds the pixels of the scene's image that can show something.
void placePixels(RayCastScene& scene)
{
  scene.image.part.box = { glm::ivec2(0), scene.image.size };
  if (scene.image.skips)
  {
    placeSeenPixels(scene);
  }
}

// The image in full size and quality.
void beginImage(const PictureWish& wish, RayCastScene& scene)
{
  scene.image = SceneImage();
  scene.image.size = wish.size;
  scene.image.skips = scene.skipping.allowed;
  scene.image.countSamples = wish.countSamples;
  placePixels(scene);
}

// Fewer pixels and longer steps.
void adapt(const MovingQuality& quality, RayCastScene& scene)
{
  SceneImage& image = scene.image;
  image.stepDoublings = scene.tissue.blend == Blend::Composite ? quality.stepDoublings : 0;
  image.size = glm::max(image.size / quality.imageScale, glm::ivec2(1));
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
}

bool isMovingPicture(const PictureWish& wish)
{
  return wish.adaptive && isMoving(wish.rate);
}

void Picture::bend(const FieldTexture::Bent& bent)
{
  this->Bent.add(bent);
}

void Picture::castAgain()
{
  if (this->LastWasWhole)
  {
    this->forget();
  }
  else
  {
    this->Again = enclosing(this->Again, this->LastPart);
  }
}

bool Picture::cast(
  GpuTask& gpu, const DrawnVolume& drawn, const PictureWish& wish, RayCastScene& scene)
{
  beginImage(wish, scene);
  const PictureStamp::Change change =
    this->Stamp.change(drawn, wish.settingsTime, scene, gpu.counters);
  const bool kept = this->canKeep(change, wish, scene);
  gpu.counters.imageScale = 1;
  const bool cast = kept ? this->castChanged(gpu, wish, scene) : this->castAll(gpu, wish, scene);
  const bool done = cast && this->occlude(gpu, wish, scene);
  if (!done)
  {
    this->forget();
  }
  if (!isMovingPicture(wish))
  {
    this->Rough.images().releaseGraphicsResources(gpu.window);
  }
  return done;
}

// Whether something of the last picture can stay.
bool Picture::canKeep(
  PictureStamp::Change change, const PictureWish& wish, const RayCastScene& scene)
{
  if (scene.image.countSamples || !this->images().hold(scene) ||
    (!this->isBent() && this->RoughPart.empty() && this->Again.empty() && !wish.keep))
  {
    return false;
  }
  switch (change)
  {
    case PictureStamp::Nothing:
      return isMovingPicture(wish) || !this->Mixed;
    case PictureStamp::Bending:
      return !scene.comparison.reference && (isMovingPicture(wish) || !this->Mixed);
    case PictureStamp::Reaching:
      // Samples lie elsewhere on their rays. The difference is that of a rough picture.
      this->Mixed = true;
      return !scene.comparison.reference && isMovingPicture(wish);
    default:
      return false;
  }
}

bool Picture::castAll(GpuTask& gpu, const PictureWish& wish, RayCastScene& scene)
{
  const MovingQuality quality = this->qualityFor(wish, partOf(scene.image.part.box));
  gpu.counters.imageScale = quality.imageScale;
  adapt(quality, scene);
  scene.image.jitter = isMovingPicture(wish);
  scene.behind = this->Depth.captureBehind(gpu.window, wish.origin, wish.size, scene.image);
  const bool cast = this->measure(
    gpu, wish, scene, [&] { return this->Whole.cast(gpu.window, scene, gpu.counters); });
  this->Bent = FieldTexture::Bent();
  this->Space = { scene.cuts.spaceLow, scene.cuts.spaceHigh };
  this->Mixed = false;
  this->RoughPart = scene.image.jitter ? partOf({ glm::ivec2(0), wish.size }) : PixelPart();
  this->CastMoving = scene.image.jitter;
  this->LastWasWhole = true;
  this->Again = PixelPart();
  this->Occlusion.change({ glm::ivec2(0), wish.size });
  return cast;
}

// A picture that moves has no time for occlusion. The hand would see it come and go if it had some
// only while few pixels change: so it is off from the first moving picture to the next still one.
bool Picture::occlude(GpuTask& gpu, const PictureWish& wish, const RayCastScene& scene)
{
  this->Shade = PictureShade();
  this->CastMoving = this->CastMoving && isMovingPicture(wish);
  const bool wanted = wish.occlusion.darkness > 0.0; // not if it is no number
  if (!wanted || this->CastMoving || !Occlusion::isFor(scene))
  {
    return true;
  }
  const FirstHits* hits = this->images().drawnHits();
  if (!hits || !this->Occlusion.update(gpu, *hits, scene, wish.occlusion.radius))
  {
    return false;
  }
  const double darkness =
    wish.occlusion.darkness * Occlusion::seenWithin(scene, wish.occlusion.radius);
  this->Shade = { this->Occlusion.texture(), darkness, wish.margin };
  return true;
}

PixelPart Picture::changedPart(bool moving, const RayCastScene& scene) const
{
  const PixelBox filled = enclosing(scene.image.part.box, this->images().filled());
  PixelPart part =
    this->Bent.all ? partOf(filled) : pixelsBetween(this->Bent.corners, this->Space, scene);
  part = enclosing(part, this->Again);
  if (!moving)
  {
    part = enclosing(part, this->RoughPart);
  }
  part.box = overlap(part.box, filled);
  // The picture's edge may leave an octagon with as few corners as a box, which CastImages draws as
  // a box.
  return isDrawnAsBox(part) ? partOf(part.box) : part;
}

bool Picture::castChanged(GpuTask& gpu, const PictureWish& wish, RayCastScene& scene)
{
  const bool moving = isMovingPicture(wish);
  CastImages& held = this->images();
  if (!held.haveRoom(scene.image.part.box) && !held.grow(gpu.window, scene, gpu.counters))
  {
    return false;
  }
  this->Space.low = glm::min(this->Space.low, scene.cuts.spaceLow);
  this->Space.high = glm::max(this->Space.high, scene.cuts.spaceHigh);
  const PixelPart part = this->changedPart(moving, scene);
  MovingQuality quality = this->qualityFor(wish, part);
  quality.stepDoublings = 0; // beside what stays, surfaces would look grainy
  bool done = true;
  if (!part.empty() && !quality.isFull())
  {
    done = this->castRoughly(gpu, wish, quality, scene, part);
    this->RoughPart = enclosing(this->RoughPart, part);
  }
  else if (!part.empty())
  {
    scene.image.part = part;
    scene.behind = this->Depth.captureBehind(gpu.window, wish.origin, wish.size, scene.image);
    done = this->measure(
      gpu, wish, scene, [&] { return this->Whole.castPart(gpu.window, scene, gpu.counters); });
  }
  if (!moving)
  {
    this->RoughPart = PixelPart();
  }
  this->CastMoving = this->CastMoving || (moving && !part.empty());
  this->LastPart = part;
  this->LastWasWhole = false;
  this->Again = PixelPart();
  this->Occlusion.change(part.box);
  this->Bent = FieldTexture::Bent();
  return done;
}

bool Picture::castRoughly(GpuTask& gpu, const PictureWish& wish, const MovingQuality& quality,
  const RayCastScene& scene, const PixelPart& part)
{
  gpu.counters.imageScale = quality.imageScale;
  RayCastScene rough = scene;
  adapt(quality, rough);
  rough.image.part = reduced(part, wish.size, rough.image.size);
  rough.image.jitter = true;
  rough.image.hitFromFraction = this->images().hitFromFraction(scene);
  rough.behind = this->Depth.captureBehind(gpu.window, wish.origin, wish.size, rough.image);
  return this->measure(
           gpu, wish, rough, [&] { return this->Rough.cast(gpu.window, rough, gpu.counters); }) &&
    this->images().enlarge(gpu.window, this->Rough.images(), part, gpu.counters);
}

MovingQuality Picture::qualityFor(const PictureWish& wish, const PixelPart& part) const
{
  return isMovingPicture(wish)
    ? movingQuality(this->SecondsPerPixel * pixelsIn(part),
        allowedSeconds(wish.rate, this->Pace.windowSeconds(), this->Pace.spentSeconds()))
    : MovingQuality();
}

template <typename Cast>
bool Picture::measure(
  const GpuTask& gpu, const PictureWish& wish, const RayCastScene& scene, const Cast& cast)
{
  vtkNew<vtkTimerLog> timer;
  timer->StartTimer();
  if (!cast())
  {
    return false;
  }
  const double pixels = pixelsIn(scene.image.part);
  if (wish.adaptive && (pixels >= FewPixels || (pixels > 0.0 && this->SecondsPerPixel == 0.0)))
  {
    gpu.window->WaitForCompletion(); // else the time would be that of the commands alone
    timer->StopTimer();
    this->SecondsPerPixel = timer->GetElapsedTime() * (1 << scene.image.stepDoublings) / pixels;
  }
  return true;
}

std::vector<glm::vec2> Picture::takeWishes()
{
  std::vector<glm::vec2> all = this->Whole.images().takeWishes();
  const std::vector<glm::vec2> rough = this->Rough.images().takeWishes();
  all.insert(all.end(), rough.begin(), rough.end());
  return all;
}

std::vector<vtkTextureObject*> Picture::textures() const
{
  std::vector<vtkTextureObject*> all = this->Whole.images().textures();
  const std::vector<vtkTextureObject*> rough = this->Rough.images().textures();
  all.insert(all.end(), rough.begin(), rough.end());
  const std::vector<vtkTextureObject*> occlusion = this->Occlusion.textures();
  all.insert(all.end(), occlusion.begin(), occlusion.end());
  all.push_back(this->Depth.copied());
  return all;
}

void Picture::releaseGraphicsResources(vtkWindow* window)
{
  this->Whole.releaseGraphicsResources(window);
  this->Rough.releaseGraphicsResources(window);
  this->Occlusion.releaseGraphicsResources(window);
  this->Depth.releaseGraphicsResources(window);
  this->Stamp.forget();
}
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Picture/VolumeDevice.h"

#include "Representations/Picture/PictureCapture.h"
#include "Representations/Picture/SeenPixels.h"

#include "vtkImageData.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkVolume.h"
#include "vtkVolumeMapper.h"

#include <glm/gtc/matrix_transform.hpp>

namespace brainshift
{
namespace
{
SceneBlending blendingFor(const VolumeRequest& request, const TissueRequest& tissue,
  const TissueTextures& textures, const SceneFrame& frame)
{
  return blendingOf(request.mapper, tissue.property, tissue.values.scalars, textures.stored(),
    frame.worldFromTexture);
}
}

namespace
{
// Tiles of a large picture show light that tissue of their neighbours hides: a margin of it is cast
// with each of them.
void widenTile(PictureWish& wish, RayCastScene& scene)
{
  const OcclusionWish& occlusion = wish.occlusion;
  const bool occluded = occlusion.darkness > 0.0 && Occlusion::isFor(scene);
  if (!scene.frame.tile || !occluded || isMovingPicture(wish))
  {
    return;
  }
  wish.margin = Occlusion::reach(scene.frame.clipFromWorld, wish.size, occlusion.radius);
  const glm::ivec2 tile = wish.size;
  wish.origin -= wish.margin;
  wish.size += 2 * wish.margin;
  const glm::dvec2 smaller = glm::dvec2(tile) / glm::dvec2(wish.size);
  scene.frame.clipFromWorld =
    glm::scale(glm::dmat4(1.0), glm::dvec3(smaller, 1.0)) * scene.frame.clipFromWorld;
}
}

namespace
{
MemoryNeed needOf(const VolumeRequest& request, const SceneDeformation& deformation)
{
  DrawnSizes sizes;
  addTissueSizes(request.tissue, sizes);
  sizes.pixels = request.wish.size;
  deformation.addSizes(sizes);
  MemoryNeed need = memoryNeed(sizes);
  need.reference = request.reference.exists() ? referenceBytes(request.reference) : 0;
  return need;
}
}

bool VolumeDevice::draw(
  GpuTask& gpu, const DrawnVolume& drawn, SceneDeformation& deformation, VolumeRequest request)
{
  PictureWish& wish = request.wish;
  gpu.moving = isMovingPicture(wish);
  drawn.renderer->GetTiledSizeAndOrigin(&wish.size.x, &wish.size.y, &wish.origin.x, &wish.origin.y);
  takeOutOfMemory(); // errors of others
  const auto draw = [&] {
    VolumeRequest possible = request;
    return this->askForMemory(gpu, deformation, possible) &&
      this->drawTissue(gpu, drawn, deformation, possible);
  };
  const MemoryNeed need = needOf(request, deformation);
  if (request.part.empty()) // ranks stream nothing
  {
    auto image = vtkImageData::SafeDownCast(request.mapper->GetDataSetInput());
    request.tissue.finerBy = finerVoxelsBy(image, request.tissue, /*ofSlices*/ false);
  }
  this->Bricks.rest();
  const bool isDrawn = this->Level.draw(gpu, request.tissue, need, request.memoryLimitMiB, [&] {
    const bool done = draw();
    if (takeOutOfMemory())
    {
      this->Memory.refuse();
      this->Picture.forget();
      return draw(); // less of it, if anything
    }
    return done;
  });
  if (!isDrawn)
  {
    this->Bricks.rest();
  }
  return isDrawn;
}

// Memory is requested before it is taken: some drivers end the program when there is none. If there
// is too little for the reference, the volume is drawn without it.
bool VolumeDevice::askForMemory(
  GpuTask& gpu, const SceneDeformation& deformation, VolumeRequest& request)
{
  MemoryNeed need = needOf(request, deformation);
  if (request.reference.exists())
  {
    if (this->Deformation.askForMemory(gpu, this->Memory, need, request.memoryLimitMiB))
    {
      return true;
    }
    this->leaveOutReference(gpu);
    need.reference = 0;
    request.reference = SceneReference();
  }
  return this->Deformation.askForMemory(gpu, this->Memory, need, request.memoryLimitMiB);
}

bool VolumeDevice::drawTissue(GpuTask& gpu, const DrawnVolume& drawn, SceneDeformation& deformation,
  const VolumeRequest& request)
{
  const bool waits = request.waits && !gpu.moving;
  PictureCapture& capture = PictureCapture::current();
  if (waits)
  {
    capture.join(gpu.window, this, isLeftEye(drawn));
  }
  else
  {
    capture.end();
  }
  bool isLast = true;
  this->Picture.begin();
  do
  {
    isLast = !waits || StreamedBricks::Clock::now() >= capture.deadline();
    if (!this->castTissue(gpu, drawn, deformation, request))
    {
      return false;
    }
    this->Bricks.finish(this->Picture.takeWishes());
    if (this->Bricks.asksAgain())
    {
      this->Picture.castAgain();
    }
  } while (!isLast && this->Bricks.waitForMore(capture.deadline()));
  if (waits)
  {
    capture.reportIfCoarse(gpu, this->Bricks);
  }
  const PictureWish& wish = request.wish;
  const bool done = this->images().composite(
    gpu.window, { wish.origin, wish.origin + wish.size }, this->Picture.shade(), gpu.counters);
  this->Picture.end();
  return done;
}

bool VolumeDevice::castTissue(GpuTask& gpu, const DrawnVolume& drawn, SceneDeformation& deformation,
  const VolumeRequest& request)
{
  RayCastScene scene;
  RayCastScene referenceScene;
  bool alone = request.reference.isAlone();
  if (alone && !this->uploadReference(gpu, drawn, request, scene))
  {
    this->leaveOutReference(gpu);
    scene = RayCastScene();
    alone = false;
  }
  if (!alone && !this->uploadVolume(gpu, drawn, deformation, request, scene))
  {
    return false;
  }
  gpu.remarks.push_back(this->Tissue.Textures.remark());
  if (request.reference.exists() && !request.reference.isAlone())
  {
    this->compare(gpu, drawn, request, scene, referenceScene);
  }
  this->askForBricks(gpu, drawn, request.wish, scene);
  PictureWish wish = request.wish;
  const glm::dmat4 clipFromWorld = scene.frame.clipFromWorld;
  widenTile(wish, scene);
  if (!this->Picture.cast(gpu, drawn, wish, scene))
  {
    return gpu.fail(
      "The ray caster's shader does not compile or its images cannot be made on this GPU");
  }
  if (wish.margin > 0)
  {
    this->images().trimTile(wish.margin, clipFromWorld);
  }
  return true;
}

// Rays ask for bricks until nothing is missing, and again when they may see other tissue.
void VolumeDevice::askForBricks(
  const GpuTask& gpu, const DrawnVolume& drawn, const PictureWish& wish, RayCastScene& scene)
{
  if (!scene.bricks.pages)
  {
    return;
  }
  scene.image.size = wish.size;
  ViewStamp& stamp = this->Views[this->Bricks.eye()];
  const ViewStamp::Change change = stamp.change(drawn, wish.settingsTime, scene, gpu.counters);
  if (change == ViewStamp::View)
  {
    this->Bricks.beginView();
  }
  scene.bricks.asks = this->Bricks.asks(change != ViewStamp::Nothing);
}

namespace
{
// Cropping counts from the same box on each rank.
DrawnValues valuesToCrop(const VolumeRequest& request)
{
  DrawnValues values = request.tissue.values;
  if (!request.part.empty())
  {
    Grid& grid = values.grid;
    grid.origin = grid.worldFromGrid(request.wholeLow) - request.wholeLow * grid.spacing;
  }
  return values;
}
}

namespace
{
// A field whose space is what a rank's rays see of it: its part, and around it the samples that are
// before its border because parts end at even ones, also those of the longest step while moving.
SceneField seenOf(SceneField field, const VolumeRequest& request)
{
  const std::vector<double>& part = request.part;
  const DrawnValues& values = request.tissue.values;
  if (part.empty())
  {
    return field;
  }
  TextureBox box{ glm::dvec3(1e300), glm::dvec3(-1e300) };
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::dvec3 world(
      part[corner & 1], part[2 + (corner >> 1 & 1)], part[4 + (corner >> 2 & 1)]);
    const glm::dvec3 texture = textureFromWorld(values, world);
    box.low = glm::min(box.low, texture);
    box.high = glm::max(box.high, texture);
  }
  const double beforeMm = 2.0 * request.tissue.stepMm * (1 << MostStepDoublings);
  const glm::dvec3 margin = beforeMm / values.grid.spacing * values.layout.textureFromGrid +
    double(BrickSide) / glm::dvec3(values.layout.dimensions);
  field.spaceLow = glm::min(glm::max(field.spaceLow, box.low - margin), field.spaceHigh);
  field.spaceHigh = glm::max(glm::min(field.spaceHigh, box.high + margin), field.spaceLow);
  return field;
}
}

namespace
{
// Where bricks that came can be seen. `farthest`: lattice cells that tissue may have moved.
FieldTexture::Bent whereBricksCame(
  const SceneBricks& bricks, const SceneField& field, const glm::vec3& farthest)
{
  constexpr double margin = 4.0; // voxels; what lies outside of the level reads its first and last
  const glm::ivec3 count(glm::ceil(bricks.voxels / double{ StreamedSide }));
  const auto latticeFromVoxel = [&](const glm::dvec3& voxel) {
    return glm::vec3(
      (voxel - bricks.voxelOfTextureZero) / bricks.voxelFromTexture * field.latticeFromTexture +
      field.latticeOfTextureZero);
  };
  FieldTexture::Bent bent;
  for (const int brick : bricks.arrived)
  {
    const glm::dvec3 first(
      glm::ivec3(brick % count.x, brick / count.x % count.y, brick / (count.x * count.y)) *
      StreamedSide);
    const glm::vec3 low = latticeFromVoxel(first - margin);
    const glm::vec3 high = latticeFromVoxel(first + (StreamedSide + margin));
    for (int corner = 0; corner < 8; ++corner)
    {
      const glm::vec3 side(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
      bent.corners.push_back(glm::mix(low - farthest, high + farthest, side));
    }
  }
  return bent;
}
}

// What is drawn of the volume, with the finer level that suits the view.
TissueRequest VolumeDevice::planBricks(
  GpuTask& gpu, const DrawnVolume& drawn, const VolumeRequest& request, const MemoryNeed& need)
{
  TissueRequest tissue = request.tissue;
  BrickView view = brickViewOf(drawn, tissue.values, need, request.memoryLimitMiB);
  view.pixels = request.wish.size;
  view.asks = !request.wish.countSamples;
  this->Bricks.plan(gpu, view, tissue);
  if (!view.asks && this->Bricks.isStreamed())
  {
    gpu.remarks.push_back("No finer voxels come while samples are counted: switch Count Samples "
                          "off to draw all detail");
  }
  return tissue;
}

// The volume with its offset field and the bricks of the deformed frame.
bool VolumeDevice::uploadVolume(GpuTask& gpu, const DrawnVolume& drawn,
  SceneDeformation& deformation, const VolumeRequest& request, RayCastScene& scene)
{
  const TissueRequest tissue = this->planBricks(gpu, drawn, request, needOf(request, deformation));
  DeviceDeformation::Change change;
  if (!this->Tissue.Textures.update(gpu, tissue, scene.tissue))
  {
    return false;
  }
  this->Bricks.upload(gpu, this->Tissue.Textures, scene.bricks);
  if (!this->Deformation.update(gpu, deformation, tissue.values, scene.field, change))
  {
    return false;
  }
  this->Picture.bend(change.bent); // the next picture needs it if this one fails
  this->Picture.bend(whereBricksCame(scene.bricks, scene.field,
    deformation.deformed ? this->Deformation.field().farthestMove() : glm::vec3(0.0f)));
  const SceneField seen = seenOf(scene.field, request);
  if (!this->Tissue.updateBricks(gpu, tissue, seen, change.computed, scene.skipping))
  {
    return false;
  }
  if (request.showsEvidence &&
    !this->Evidence.update(gpu, deformation, tissue.values, scene.evidence))
  {
    return false;
  }
  scene.frame = frameOf(drawn, tissue.values);
  const VolumePlace place{ scene.frame.worldFromTexture, drawn.volume->GetMatrix() };
  if (!this->Resected.update(gpu, request.resection, place, scene.resection))
  {
    return false;
  }
  SceneField space = scene.field;
  if (!request.part.empty() && !deformation.deformed)
  {
    // Samples count from the same box on each rank.
    space.spaceLow = tissue.values.layout.textureAt(request.wholeLow);
    space.spaceHigh = tissue.values.layout.textureAt(request.wholeHigh);
  }
  scene.cuts = cutsOf(request.mapper, valuesToCrop(request), scene.frame, space);
  scene.cuts.partPlanes = partPlanesOf(request.part, scene.frame.worldFromTexture);
  scene.cuts.partTissue = request.partTissue;
  scene.blending = blendingFor(request, tissue, this->Tissue.Textures, scene.frame);
  return true;
}

// The reference in place of the volume: not bent, in ordinary colours, cropped as the volume is.
bool VolumeDevice::uploadReference(
  GpuTask& gpu, const DrawnVolume& drawn, const VolumeRequest& request, RayCastScene& scene)
{
  if (!this->Reference.update(gpu, drawn, request.reference, scene))
  {
    return false;
  }
  const DrawnValues& values = request.tissue.values;
  const glm::dmat4 worldFromVolumeTexture =
    worldFromTexture(values.grid, values.layout, drawn.volume->GetMatrix());
  bool exact = true;
  scene.cuts =
    cutsOfReference(request.mapper, scene, valuesToCrop(request), worldFromVolumeTexture, exact);
  if (!exact)
  {
    gpu.remarks.emplace_back(
      "Only the middle cropping region cuts a reference that is shown alone");
  }
  if (!request.part.empty()) // as in uploadVolume
  {
    const TissueRequest& tissue = request.reference.tissue;
    const glm::dvec3 first(request.reference.first);
    const glm::dvec3 last(tissue.wholePoints - 1);
    scene.cuts.spaceLow = tissue.values.layout.textureAt(-first);
    scene.cuts.spaceHigh = tissue.values.layout.textureAt(last - first);
  }
  scene.cuts.partPlanes = partPlanesOf(request.part, scene.frame.worldFromTexture);
  scene.blending =
    blendingFor(request, request.reference.tissue, this->Reference.Tissue.Textures, scene.frame);
  return true;
}

// If the reference cannot be drawn, the volume is drawn alone.
void VolumeDevice::compare(GpuTask& gpu, const DrawnVolume& drawn, const VolumeRequest& request,
  RayCastScene& scene, RayCastScene& alone)
{
  if (!this->Reference.compare(gpu, drawn, request.reference, scene, alone))
  {
    this->leaveOutReference(gpu);
  }
}

// The volume is drawn without it.
void VolumeDevice::leaveOutReference(GpuTask& gpu)
{
  this->Reference.releaseGraphicsResources(gpu.window);
  gpu.goOnWithout("The reference is not drawn");
}

bool VolumeDevice::coverSelection(GpuTask& gpu, vtkRenderer* renderer)
{
  const FirstHits* hits = this->images().hits();
  return !hits || this->Cover.draw(gpu.window, renderer, *hits, gpu.counters);
}

void VolumeDevice::addHeldBytes(Counters& counters)
{
  counters.gpuScalarBytes +=
    textureBytes(this->Tissue.Textures.scalars()) + textureBytes({ this->Bricks.textures() });
  counters.gpuOtherBytes += this->Tissue.otherBytes() + this->Reference.bytes() +
    textureBytes({ this->Deformation.field().textures(), this->Picture.textures(),
      { this->Evidence.texture() }, this->Resected.textures() });
  this->Deformation.askTime(counters.gpuFieldMicroseconds);
}

void VolumeDevice::Release(vtkWindow* window)
{
  this->Bricks.release(window);
  this->Tissue.releaseGraphicsResources(window);
  this->Reference.releaseGraphicsResources(window);
  this->Deformation.releaseGraphicsResources(window);
  this->Evidence.releaseGraphicsResources(window);
  this->Resected.releaseGraphicsResources(window);
  this->Picture.releaseGraphicsResources(window);
  this->Cover.releaseGraphicsResources();
}
}

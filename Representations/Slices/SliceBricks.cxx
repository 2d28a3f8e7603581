// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Slices/SliceBricks.h"

#include "Representations/Gpu/SceneScope.h"
#include "Representations/Gpu/VolumePass.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkTextureObject.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace brainshift
{
namespace
{
constexpr int PixelsOfMoving = 4; // a side: while the picture moves, one of so many asks
constexpr int LeastPixels = StreamedSide / 2; // a side: a brick of a level that suits the view
constexpr double MoreBricks = 1.5;            // where a bent slice crosses more of them
constexpr float NoBrick[4] = { -1.0f, -1.0f, -1.0f, -1.0f };

// Of all quads, texture coordinates.
std::vector<glm::dvec3> cornersOf(const std::vector<SliceQuad>& quads)
{
  std::vector<glm::dvec3> corners;
  for (const SliceQuad& quad : quads)
  {
    corners.insert(corners.end(),
      { quad.corner, quad.corner + quad.right, quad.corner + quad.up,
        quad.corner + quad.right + quad.up });
  }
  return corners;
}

// A power of two, so that a window that changes its size a little reads no brick again.
std::int64_t mostBricks(const glm::ivec2& pixels, std::size_t quads)
{
  const glm::dvec2 aSide = glm::dvec2(pixels) / static_cast<double>(LeastPixels) + 1.0;
  const double most = MoreBricks * aSide.x * aSide.y * static_cast<double>(quads);
  return std::int64_t(1) << static_cast<int>(std::ceil(std::log2(std::max(most, 1.0))));
}

bool areSame(const std::vector<double>& a, const std::vector<double>& b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
    [](double one, double other) { return std::abs(one - other) <= 1e-12 * std::abs(one); });
}
}

void SliceBricks::update(GpuTask& gpu, BrickView view, const SliceTissue& tissue, SliceScene& scene,
  const std::optional<Clock::time_point>& end)
{
  const std::vector<SliceQuad> quads = wholeQuads(scene.planes);
  view.ofSlices = true;
  view.corners = cornersOf(quads);
  view.mostBricks = mostBricks(view.pixels, quads.size());
  bool isLast = true;
  do
  {
    isLast = !end || Clock::now() >= *end;
    TissueRequest sampled = tissue.request;
    this->Bricks.plan(gpu, view, sampled);
    this->Bricks.upload(gpu, tissue.textures, scene.bricks);
    this->Bricks.finish(this->ask(gpu, scene, view.pixels));
  } while (!isLast && this->Bricks.waitForMore(*end));
}

std::int64_t SliceBricks::bytesOf(const glm::ivec2& pixels)
{
  constexpr std::int64_t ofPixel = 2 * sizeof(float) + 4; // Numbers, and Depth with its padding
  return ofPixel * pixels.x * pixels.y;
}

// Each pixel names the brick that it reads. While the picture moves, few pixels ask.
std::vector<glm::vec2> SliceBricks::ask(
  GpuTask& gpu, const SliceScene& scene, const glm::ivec2& pixels)
{
  if (!scene.bricks.pages)
  {
    return {};
  }
  const glm::ivec2 asking = gpu.moving ? (pixels - 1) / PixelsOfMoving + 1 : pixels;
  const bool isChanged = this->isChanged(gpu, scene, asking);
  if (isChanged)
  {
    this->Bricks.beginView();
  }
  if (!this->Bricks.asks(isChanged))
  {
    return {};
  }
  Program& program = this->Programs[scene.field.offsets ? 1 : 0];
  if (!this->prepare(gpu.window, pixels) ||
    !program.use(gpu.window, sliceBricksSource(scene.field.offsets != nullptr), gpu.counters))
  {
    this->Bricks.rest();
    gpu.remarks.emplace_back("The slices get no finer voxels: this GPU cannot make the image that "
                             "asks for them, or its shader does not compile");
    return {};
  }
  return this->drawNumbers(gpu.window, scene, asking);
}

// Whether the slices may read other bricks than when this eye asked last.
bool SliceBricks::isChanged(const GpuTask& gpu, const SliceScene& scene, const glm::ivec2& pixels)
{
  std::vector<double> now{ static_cast<double>(pixels.x), static_cast<double>(pixels.y),
    scene.blended ? 1.0 : 0.0 };
  const glm::dmat4 rows = glm::transpose(clipFromTexture(scene.frame));
  for (const int row : { 0, 1, 3 }) // the clipping planes follow what else is in the view
  {
    for (int column = 0; column < 4; ++column)
    {
      now.push_back(rows[row][column]);
    }
  }
  const SlicePlanes& planes = scene.planes;
  for (int axis = 0; axis < 3; ++axis)
  {
    now.insert(now.end(),
      { planes.shown[axis] ? 1.0 : 0.0, planes.position[axis], planes.low[axis],
        planes.high[axis] });
  }
  const Counters& count = gpu.counters;
  for (const std::int64_t bent :
    { count.latticeUploads, count.texelsRefined, count.correctionBytes })
  {
    now.push_back(static_cast<double>(bent));
  }
  std::vector<double>& last = this->Asked[this->Bricks.eye()];
  const bool isSame = areSame(now, last);
  last = std::move(now);
  return !isSame;
}

bool SliceBricks::prepare(vtkOpenGLRenderWindow* window, const glm::ivec2& pixels)
{
  const glm::uvec2 size(pixels);
  if (this->Numbers && this->Numbers->GetWidth() == size.x && this->Numbers->GetHeight() == size.y)
  {
    return true;
  }
  constexpr int channels = 2;
  this->Numbers = makeTexture(window, GL_RG32F, vtkTextureObject::Nearest);
  this->Depth = makeTexture(window, GL_DEPTH_COMPONENT24, vtkTextureObject::Nearest);
  const bool isMade = this->Numbers->Allocate2D(size.x, size.y, channels, VTK_FLOAT) &&
    this->Depth->AllocateDepth(size.x, size.y, vtkTextureObject::Fixed24) && !takeOutOfMemory();
  if (!isMade)
  {
    takeOutOfMemory();
    this->Numbers = nullptr;
    this->Depth = nullptr;
  }
  return isMade;
}

// Through opaque slices nothing behind is seen, through others all of it. Other things in the view
// hide nothing here.
std::vector<glm::vec2> SliceBricks::drawNumbers(
  vtkOpenGLRenderWindow* window, const SliceScene& scene, const glm::ivec2& pixels)
{
  const bool isBent = scene.field.offsets != nullptr;
  Program& program = this->Programs[isBent ? 1 : 0];
  program.set("clipFromTexture", glm::mat4(clipFromTexture(scene.frame)));
  program.set("volumeLow", glm::vec3(scene.tissue.volumeLow));
  program.set("volumeHigh", glm::vec3(scene.tissue.volumeHigh));
  setBrickUniforms(program, scene.bricks);
  if (isBent)
  {
    setFieldUniforms(program, scene.field);
  }
  vtkOpenGLState* state = window->GetState();
  const SceneScope scope(state, false);
  const vtkOpenGLState::ScopedglEnableDisable scissor(state, GL_SCISSOR_TEST);
  FramebufferScope framebuffer(state);
  state->vtkglDisable(GL_SCISSOR_TEST);
  state->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  state->vtkglViewport(0, 0, pixels.x, pixels.y);
  glFramebufferTexture2D(
    GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, this->Numbers->GetHandle(), 0);
  glFramebufferTexture2D(
    GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, this->Depth->GetHandle(), 0);
  framebuffer.drawColors(1);
  state->vtkglReadBuffer(GL_COLOR_ATTACHMENT0);
  const std::vector<SliceQuad> quads = wholeQuads(scene.planes);
  const std::size_t picture = static_cast<std::size_t>(pixels.x) * pixels.y;
  std::vector<glm::vec2> numbers;
  for (std::size_t i = 0; i < quads.size(); ++i)
  {
    if (i == 0 || scene.blended)
    {
      constexpr float farthest = 1.0f;
      glClearBufferfv(GL_COLOR, 0, NoBrick);
      glClearBufferfv(GL_DEPTH, 0, &farthest);
    }
    drawQuad(program, quads[i]);
    if (i + 1 == quads.size() || scene.blended)
    {
      numbers.resize(numbers.size() + picture);
      glReadPixels(0, 0, pixels.x, pixels.y, GL_RG, GL_FLOAT, &numbers[numbers.size() - picture]);
    }
  }
  scene.bricks.pages->Deactivate();
  scene.bricks.atlas->Deactivate();
  deactivateField(scene.field);
  return numbers;
}

void SliceBricks::releaseGraphicsResources(vtkWindow* window)
{
  for (vtkTextureObject* image : this->images())
  {
    if (image)
    {
      image->ReleaseGraphicsResources(window);
    }
  }
  this->Bricks.release(window);
  *this = SliceBricks();
}
}

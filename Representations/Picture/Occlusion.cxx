// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Picture/Occlusion.h"

#include "Representations/Picture/CastImages.h"
#include "Representations/Picture/ImageScope.h"
#include "Representations/Scene/RayCastScene.h"

#include "vtkOpenGLRenderWindow.h"

#include <cmath>

namespace brainshift
{
namespace
{
constexpr int Cell = 4;        // pixels a side that sample different directions
constexpr int SmoothReach = 2; // pixels around one that the second pass reads
constexpr double SameFraction =
  0.5; // of the radius: a greater difference in depth: another surface

PixelBox widened(const PixelBox& box, int pixels)
{
  return { box.low - pixels, box.high + pixels };
}

// mm in the world for one before an actor's scale.
double scaleOf(const SceneFrame& frame)
{
  const glm::dvec3& side = frame.mmFromTexture;
  const double scaled = std::abs(glm::determinant(glm::dmat3(frame.worldFromTexture)));
  return std::cbrt(scaled / (side.x * side.y * side.z));
}

// mm in the world. Tissue is known to half a voxel. With longer steps a first hit is not, so two
// neighbours may seem to lean by half a step each. Shorter steps change nothing: a picture would
// get darker with each.
double toleranceOf(const RayCastScene& scene)
{
  const glm::dvec3& side = scene.frame.mmFromTexture;
  const SceneBricks& bricks = scene.bricks;
  const glm::dvec3 voxel =
    (bricks.pages ? 1.0 / bricks.voxelFromTexture : scene.tissue.voxel) * side;
  const double known = 0.5 * glm::min(glm::min(voxel.x, voxel.y), voxel.z);
  return glm::max(known, 0.5 * scene.stepMm()) * scaleOf(scene.frame);
}

double depthOf(const Frustum& frustum)
{
  const glm::dvec3 ahead = glm::normalize(glm::cross(frustum.near.right, frustum.near.up));
  return std::abs(glm::dot(frustum.far.origin - frustum.near.origin, ahead));
}

// Sides of a pixel, mm.
glm::dvec2 pixelOn(const FrustumPlane& plane, const glm::ivec2& picture)
{
  return 2.0 * glm::dvec2(glm::length(plane.right), glm::length(plane.up)) / glm::dvec2(picture);
}

// Pixels from a hit within which others change its occlusion. None is nearer than the near plane.
int reachOf(const Frustum& frustum, const glm::ivec2& picture, double radius)
{
  const glm::dvec2 pixel = pixelOn(frustum.near, picture);
  const double pixels = std::ceil(radius / glm::min(pixel.x, pixel.y)) + 1.0;
  return static_cast<int>(glm::min(pixels, static_cast<double>(MostOcclusionPixels)));
}

void setUniforms(Program& program, const FirstHits& hits)
{
  const ImageArea& area = hits.area;
  const Frustum& frustum = hits.frustum;
  const glm::dvec2 nearPixel = pixelOn(frustum.near, area.picture);
  const glm::dvec2 ndc = 2.0 * glm::dvec2(area.low) / glm::dvec2(area.picture) - 1.0;
  const glm::dvec3 across = frustum.far.at(ndc) - frustum.near.at(ndc);
  program.set("hits", hits.texture.Get());
  program.set("hitsTexel", 1.0f / glm::vec2(area.size));
  program.set("pictureLow", glm::vec2(-area.low));
  program.set("pictureHigh", glm::vec2(area.picture - area.low));
  program.set("nearPixel", glm::vec2(nearPixel));
  program.set("pixelGrowth", glm::vec2(pixelOn(frustum.far, area.picture) - nearPixel));
  program.set("acrossAtZero",
    glm::vec3(glm::dot(across, glm::normalize(frustum.near.right)),
      glm::dot(across, glm::normalize(frustum.near.up)), depthOf(frustum)));
}
}

bool Occlusion::isFor(const RayCastScene& scene)
{
  const Blend blend = scene.tissue.blend;
  return scene.tissue.shaded && !scene.comparison.reference &&
    (blend == Blend::Composite || blend == Blend::Isosurface);
}

double Occlusion::seenWithin(const RayCastScene& scene, double radius)
{
  if (scene.tissue.blend != Blend::Composite)
  {
    return 1.0; // an isosurface has no depth
  }
  const double steps = radius / (scaleOf(scene.frame) * scene.tissue.stepMm);
  return 1.0 - std::pow(1.0 - glm::clamp(scene.tissue.largestOpacity, 0.0, 1.0), steps);
}

int Occlusion::reach(const glm::dmat4& clipFromWorld, const glm::ivec2& size, double radius)
{
  // Whole cells of 4 by 4 pixels, so that their pattern stays.
  const int reached = reachOf(frustumOf(clipFromWorld), size, radius) + SmoothReach;
  return (reached + Cell - 1) / Cell * Cell;
}

bool Occlusion::prepare(GpuTask& gpu, const ImageArea& area)
{
  if (area == this->Area && this->Rough && this->Smooth)
  {
    return true;
  }
  const bool sameSize = area.size == this->Area.size && this->Rough && this->Smooth;
  this->Area = area;
  this->Stale = area.box();
  if (!sameSize)
  {
    this->Rough = makeImage(gpu.window, area.size, GL_RG16, vtkTextureObject::Nearest);
    this->Smooth = makeImage(gpu.window, area.size, GL_R8, vtkTextureObject::Nearest);
  }
  return this->Rough && this->Smooth;
}

bool Occlusion::update(
  GpuTask& gpu, const FirstHits& hits, const RayCastScene& scene, double radius)
{
  if (!this->prepare(gpu, hits.area))
  {
    return false;
  }
  if (this->Stale.empty())
  {
    return true;
  }
  this->Stale = overlap(
    widened(this->Stale, reachOf(hits.frustum, this->Area.picture, radius)), this->Area.box());
  if (this->Stale.empty())
  {
    return true;
  }
  const bool done =
    this->drawRough(gpu, hits, scene, radius) && this->drawSmooth(gpu, hits, radius);
  this->Stale = done ? PixelBox() : this->Area.box();
  return done;
}

bool Occlusion::drawRough(
  GpuTask& gpu, const FirstHits& hits, const RayCastScene& scene, double radius)
{
  if (!this->RoughProgram.use(gpu.window, occlusionSource(), gpu.counters))
  {
    return false;
  }
  ImageScope scope(gpu.window->GetState(), this->Stale, this->Area);
  scope.attach(0, this->Rough);
  setUniforms(this->RoughProgram, hits);
  const glm::dvec2 pixel = pixelOn(hits.frustum.near, hits.area.picture);
  // A radius far below a pixel is no number any more for the shader.
  const double shown = glm::max(radius, 1e-3 * glm::min(pixel.x, pixel.y));
  this->RoughProgram.set("radius", static_cast<float>(shown));
  this->RoughProgram.set("tolerance", static_cast<float>(toleranceOf(scene)));
  drawTriangles(1);
  hits.texture->Deactivate();
  return true;
}

bool Occlusion::drawSmooth(GpuTask& gpu, const FirstHits& hits, double radius)
{
  if (!this->SmoothProgram.use(gpu.window, smoothOcclusionSource(), gpu.counters))
  {
    return false;
  }
  const PixelBox pixels = overlap(widened(this->Stale, SmoothReach), this->Area.box());
  ImageScope scope(gpu.window->GetState(), pixels, this->Area);
  scope.attach(0, this->Smooth);
  this->SmoothProgram.set("occlusion", this->Rough.Get());
  this->SmoothProgram.set("occlusionTexel", 1.0f / glm::vec2(this->Area.size));
  this->SmoothProgram.set(
    "sameFromFraction", static_cast<float>(depthOf(hits.frustum) / (SameFraction * radius)));
  drawTriangles(1);
  this->Rough->Deactivate();
  return true;
}

void Occlusion::releaseGraphicsResources(vtkWindow* window)
{
  for (auto* image : { &this->Rough, &this->Smooth })
  {
    if (*image)
    {
      (*image)->ReleaseGraphicsResources(window);
    }
    *image = nullptr;
  }
  this->Area = ImageArea();
  this->RoughProgram.forget();
  this->SmoothProgram.forget();
}
}

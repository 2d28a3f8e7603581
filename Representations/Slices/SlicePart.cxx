// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Slices/SlicePart.h"

#include "Representations/Gpu/Program.h"
#include "Representations/Scene/RayCastScene.h"
#include "Representations/Scene/VolumeChoices.h"
#include "Representations/Slices/SliceGeometry.h"

#include "vtkMatrix4x4.h"
#include "vtkNew.h"

#include <algorithm>

namespace brainshift
{
namespace
{
constexpr int NumbersOfPlane = 4;
constexpr double OverlapVoxels = 1e-3;

PixelBox noPixels(const PixelBox& viewport)
{
  return { viewport.low, viewport.low };
}
}

SlicePart slicePartOf(
  const Box& cut, const DrawnValues& whole, const DrawnValues& held, bool overlaps)
{
  vtkNew<vtkMatrix4x4> unmoved; // ranks draw no part of a volume with a transform
  const glm::dmat4 worldFromTexture =
    brainshift::worldFromTexture(whole.grid, whole.layout, unmoved);
  SlicePart part;
  part.planes = partPlanesOf({ cut.begin(), cut.end() }, worldFromTexture);
  const glm::dvec3& side = whole.grid.spacing;
  const auto overlapMm =
    static_cast<float>(overlaps ? OverlapVoxels * std::min({ side.x, side.y, side.z }) : 0.0);
  for (std::size_t i = NumbersOfPlane - 1; i < part.planes.size(); i += NumbersOfPlane)
  {
    part.planes[i] += overlapMm;
  }
  part.low = glm::dvec3(1e300);
  part.high = glm::dvec3(-1e300);
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::dvec3 world(cut[corner & 1], cut[2 + (corner >> 1 & 1)], cut[4 + (corner >> 2 & 1)]);
    const glm::dvec3 texture = textureFromWorld(whole, world);
    part.low = glm::min(part.low, texture);
    part.high = glm::max(part.high, texture);
  }
  part.wholeVoxels = whole.layout.voxels;
  part.heldFirst = glm::round(whole.grid.gridFromWorld(held.grid.origin));
  part.heldVoxels = held.layout.perTexel * held.layout.dimensions;
  return part;
}

PixelBox pixelsOf(const SliceQuad& quad, const SlicePart& part, const glm::dmat4& clipFromTexture,
  const PixelBox& viewport)
{
  const glm::dvec3 low =
    glm::max(glm::min(quad.corner, quad.corner + quad.right + quad.up), part.low);
  const glm::dvec3 high =
    glm::min(glm::max(quad.corner, quad.corner + quad.right + quad.up), part.high);
  constexpr double rounding = 1e-6; // texture units
  if (glm::any(glm::lessThan(high + rounding, low)))
  {
    return noPixels(viewport);
  }
  glm::dvec2 least(1e300);
  glm::dvec2 most(-1e300);
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::dvec3 place(corner & 1 ? high.x : low.x, corner >> 1 & 1 ? high.y : low.y,
      corner >> 2 & 1 ? high.z : low.z);
    const glm::dvec4 clip = clipFromTexture * glm::dvec4(place, 1.0);
    if (clip.w <= 0.0) // it is in part behind the eye
    {
      return viewport;
    }
    const glm::dvec2 fraction = 0.5 * glm::dvec2(clip) / clip.w + 0.5;
    least = glm::min(least, fraction);
    most = glm::max(most, fraction);
  }
  const glm::dvec2 size(viewport.size());
  const auto pixelAt = [&](const glm::dvec2& fraction) {
    const glm::dvec2 near = glm::clamp(fraction, glm::dvec2(-1.0), glm::dvec2(2.0)); // of the view
    return viewport.low + glm::ivec2(glm::floor(near * size));
  };
  constexpr int margin = 2; // of the part's overlap and of rounding
  return overlap({ pixelAt(least) - margin, pixelAt(most) + 1 + margin }, viewport);
}

void setPartUniforms(Program& program, const SlicePart& part, bool nearest)
{
  setPartPlanes(program, part.planes);
  program.set("wholeVoxels", glm::vec3(part.wholeVoxels));
  program.set("heldFirst", glm::vec3(part.heldFirst));
  program.set("heldVoxels", glm::vec3(part.heldVoxels));
  program.set("heldNearest", nearest ? 1 : 0);
}
}

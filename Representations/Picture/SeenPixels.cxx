// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Picture/SeenPixels.h"

#include "Representations/Skipping/DeformedPresence.h"

#include <limits>

namespace brainshift
{
namespace
{
// Voxels. The rasteriser rounds to 1/256 of a pixel, so that this leaves half of BrickMargin, and
// as much again for what is farther from the eye.
constexpr double LargestPixel = 8.0;

// Where points are seen in the image.
class SeenPoints
{
public:
  // Of points in texture coordinates.
  explicit SeenPoints(const RayCastScene& scene)
    : SeenPoints(scene.frame.clipFromWorld * scene.frame.worldFromTexture, scene)
  {
  }
  // Of points in any coordinates.
  SeenPoints(const glm::dmat4& clipFromPoint, const RayCastScene& scene)
    : ClipFromPoint(clipFromPoint)
    , Size(scene.image.size)
  {
  }

  // False if it lies behind the eye.
  bool add(const glm::dvec3& point)
  {
    const glm::dvec4 clip = this->ClipFromPoint * glm::dvec4(point, 1.0);
    if (clip.w <= 0.0)
    {
      return false;
    }
    const glm::dvec2 pixel = (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * this->Size;
    const glm::dvec2 turned(pixel.x + pixel.y, pixel.x - pixel.y);
    this->low = glm::min(this->low, pixel);
    this->high = glm::max(this->high, pixel);
    this->turnedLow = glm::min(this->turnedLow, turned);
    this->turnedHigh = glm::max(this->turnedHigh, turned);
    return true;
  }

  // Two pixels more to every side: for rounding, and empty ones for a filter to blend with.
  PixelPart around() const
  {
    const glm::dvec2 far(FarPixel);
    const auto within = [](const glm::dvec2& place, const glm::dvec2& least,
                          const glm::dvec2& greatest) {
      return glm::ivec2(glm::clamp(place, least, greatest));
    };
    return { { within(glm::floor(this->low) - 2.0, glm::dvec2(0.0), this->Size),
               within(glm::ceil(this->high) + 2.0, glm::dvec2(0.0), this->Size) },
      { within(glm::floor(this->turnedLow) - 5.0, -far, far),
        within(glm::ceil(this->turnedHigh) + 5.0, -far, far) } };
  }

  glm::dvec2 low{ std::numeric_limits<double>::max() };
  glm::dvec2 high{ std::numeric_limits<double>::lowest() };
  glm::dvec2 turnedLow = low;
  glm::dvec2 turnedHigh = high;

private:
  glm::dmat4 ClipFromPoint;
  glm::dvec2 Size;
};
// As placeSeenPixels, of boxes of the scene's own bricks, which are counted from its first one.
void placeBoxes(const std::vector<IndexBox>& boxes, RayCastScene& scene)
{
  SceneImage& image = scene.image;
  const SceneSkipping& skipping = scene.skipping;
  image.part.box = { glm::ivec2(0), boxes.empty() ? glm::ivec2(0) : image.size };
  SeenPoints seen(scene);
  IndexBox bricks;
  for (const IndexBox& box : boxes)
  {
    bricks = enclosing(bricks, box);
    for (int corner = 0; corner < 8; ++corner)
    {
      const glm::ivec3 side(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
      const glm::dvec3 brick(box.first + side * box.size());
      if (!seen.add((skipping.firstBrick + brick) * skipping.textureFromBrick +
            skipping.textureOfBrickZero))
      {
        return;
      }
    }
  }
  if (boxes.empty())
  {
    return;
  }
  // From wherever it is seen, the picture is about as long as the box's middle side, or longer. For
  // tissue that lies aslant and is seen along its length it is shorter: then less is skipped than
  // could be.
  const glm::ivec3 side = bricks.size() * BrickSide;
  const int longest = glm::max(side.x, glm::max(side.y, side.z));
  const int shortest = glm::min(side.x, glm::min(side.y, side.z));
  const int middle = side.x + side.y + side.z - longest - shortest;
  const double pixels = glm::max(seen.high.x - seen.low.x, seen.high.y - seen.low.y);
  image.skips = image.skips && pixels * LargestPixel > middle;
  image.part.box = seen.around().box;
}

// Leaves only pixels at which this rank's part of the volume can be seen. Around its part, it has
// voxels for strokes to come.
void placePart(RayCastScene& scene)
{
  constexpr double margin = 0.5; // mm; tissue is where it should be to 0.05 mm
  const std::vector<double>& part = scene.cuts.partTissue;
  SeenPoints seen(scene.frame.clipFromWorld, scene);
  for (int corner = 0; corner < 8 && !part.empty(); ++corner)
  {
    glm::dvec3 point;
    for (int axis = 0; axis < 3; ++axis)
    {
      const int side = corner >> axis & 1;
      point[axis] = part[2 * axis + side] + (side ? margin : -margin);
    }
    if (!seen.add(point))
    {
      return;
    }
  }
  PixelBox& box = scene.image.part.box;
  box = part.empty() ? box : overlap(box, seen.around().box);
}

void placeBoth(RayCastScene& scene, RayCastScene& reference)
{
  const std::vector<IndexBox>& bricks = scene.skipping.presence->occupiedLayers();
  const std::vector<IndexBox>& referenceBricks = reference.skipping.presence->occupiedLayers();
  SceneImage& image = scene.image;
  reference.image.size = image.size;
  reference.image.skips = image.skips;
  placeBoxes(referenceBricks, reference);
  const PixelBox& other = reference.image.part.box;
  if (bricks.empty())
  {
    image.skips = reference.image.skips;
    image.part.box = other;
    return;
  }
  placeBoxes(bricks, scene);
  if (!referenceBricks.empty())
  {
    image.skips = image.skips && reference.image.skips;
    image.part.box.low = glm::min(image.part.box.low, other.low);
    image.part.box.high = glm::max(image.part.box.high, other.high);
  }
}
}

void placeSeenPixels(RayCastScene& scene)
{
  if (scene.comparison.reference)
  {
    placeBoth(scene, *scene.comparison.reference);
  }
  else
  {
    placeBoxes(scene.skipping.presence->occupiedLayers(), scene);
    placePart(scene);
  }
}

PixelPart pixelsBetween(
  const std::vector<glm::vec3>& positions, const TextureBox& space, const RayCastScene& scene)
{
  SeenPoints seen(scene);
  for (const glm::vec3& position : positions)
  {
    const glm::dvec3 texture =
      (glm::dvec3(position) - scene.field.latticeOfTextureZero) / scene.field.latticeFromTexture;
    if (!seen.add(glm::clamp(texture, space.low, space.high)))
    {
      return partOf({ glm::ivec2(0), scene.image.size });
    }
  }
  return positions.empty() ? PixelPart() : seen.around();
}
}

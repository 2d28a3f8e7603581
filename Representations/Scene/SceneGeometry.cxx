// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Scene/SceneGeometry.h"

#include "Filters/Attached/DeformableVolume.h"
#include "Representations/Skipping/DeformedPresence.h"
#include "Representations/Picture/RayCaster.h"

#include "vtkAbstractVolumeMapper.h"
#include "vtkCamera.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkMatrix4x4.h"
#include "vtkOpenGLCamera.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkTextureObject.h"
#include "vtkVolume.h"

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include <limits>

namespace brainshift
{
namespace
{
// Voxels. The rasteriser rounds to 1/256 of a pixel, so that this leaves half of BrickMargin, and
// as much again for what is farther from the eye.
constexpr double LargestPixel = 8.0;
}

ValueLayout layoutOf(const glm::ivec3& points, bool cells)
{
  ValueLayout layout;
  layout.dimensions = cells ? glm::max(points - 1, glm::ivec3(1)) : points;
  const glm::dvec3 values(layout.dimensions);
  layout.textureFromGrid = 1.0 / values;
  layout.textureOfGridZero = cells ? glm::dvec3(0.0) : 0.5 / values;
  layout.low = layout.textureOfGridZero;
  layout.high = glm::dvec3(points - 1) * layout.textureFromGrid + layout.textureOfGridZero;
  return layout;
}

ShownValues shownValuesOf(vtkAbstractVolumeMapper* mapper, vtkImageData* image)
{
  int cells = 0;
  vtkDataArray* scalars = vtkAbstractMapper::GetScalars(image, mapper->GetScalarMode(),
    mapper->GetArrayAccessMode(), mapper->GetArrayId(), mapper->GetArrayName(), cells);
  ShownValues shown;
  shown.grid = gridOf(image);
  shown.layout = layoutOf(shown.grid.dimensions, cells != 0);
  const glm::ivec3& values = shown.layout.dimensions;
  const vtkIdType count = static_cast<vtkIdType>(values.x) * values.y * values.z;
  shown.scalars = scalars && scalars->GetNumberOfTuples() >= count ? scalars : nullptr;
  return shown;
}

glm::dmat4 worldFromTexture(const Grid& grid, const ValueLayout& layout, vtkMatrix4x4* actor)
{
  glm::dmat4 worldFromVolume;
  for (int row = 0; row < 4; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      worldFromVolume[column][row] = actor->GetElement(row, column);
    }
  }
  glm::dmat4 volumeFromTexture(1.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    volumeFromTexture[axis] =
      glm::dvec4(grid.direction[axis] * (grid.spacing[axis] / layout.textureFromGrid[axis]), 0.0);
  }
  const glm::dvec3 gridOfTextureZero = -layout.textureOfGridZero / layout.textureFromGrid;
  volumeFromTexture[3] = glm::dvec4(grid.worldFromGrid(gridOfTextureZero), 1.0);
  return worldFromVolume * volumeFromTexture;
}

glm::dmat4 clipFromWorld(vtkRenderer* renderer)
{
  glm::dmat4 matrix(1.0);
  vtkMatrix4x4* worldToView = nullptr;
  vtkMatrix3x3* normals = nullptr;
  vtkMatrix4x4* viewToClip = nullptr;
  vtkMatrix4x4* worldToClip = nullptr;
  auto camera = vtkOpenGLCamera::SafeDownCast(renderer->GetActiveCamera());
  camera->GetKeyMatrices(renderer, worldToView, normals, viewToClip, worldToClip);
  for (int column = 0; column < 4; ++column)
  {
    for (int row = 0; row < 4; ++row)
    {
      matrix[column][row] = worldToClip->GetElement(column, row); // VTK keeps it transposed
    }
  }
  return matrix;
}

glm::dvec3 textureFromLattice(const Grid& grid, const ValueLayout& layout, const Grid& lattice)
{
  return lattice.spacing / grid.spacing * layout.textureFromGrid;
}

void widenByNodes(const Grid& lattice, const FieldNodes& nodes, double bounds[6])
{
  for (int corner = 0; corner < 8; ++corner)
  {
    const glm::vec3 side(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
    const glm::dvec3 world =
      lattice.worldFromGrid(glm::dvec3(nodes.latticeFromNode(side * glm::vec3(nodes.count - 1))));
    for (int axis = 0; axis < 3; ++axis)
    {
      bounds[2 * axis] = glm::min(bounds[2 * axis], world[axis]);
      bounds[2 * axis + 1] = glm::max(bounds[2 * axis + 1], world[axis]);
    }
  }
}

void placeField(const Grid& grid, const ValueLayout& layout, const Grid& lattice,
  const FieldNodes& nodes, RayCastScene& scene)
{
  const glm::dvec3 texturePerCell = textureFromLattice(grid, layout, lattice);
  const glm::dvec3 textureOfLatticeZero =
    grid.gridFromWorld(lattice.origin) * layout.textureFromGrid + layout.textureOfGridZero;
  const glm::dvec3 count(nodes.count);
  const glm::dvec3 first(nodes.first);
  const double perCell = nodes.perCell;
  scene.fieldFromTexture = perCell / texturePerCell / count;
  scene.fieldFromTextureShift =
    (0.5 - first * perCell) / count - textureOfLatticeZero * scene.fieldFromTexture;
  scene.fieldTexel = 0.5 / count;
  scene.spaceLow = textureOfLatticeZero + first * texturePerCell;
  scene.spaceHigh = scene.spaceLow + (count - 1.0) / perCell * texturePerCell;
  scene.latticeFromTexture = 1.0 / texturePerCell;
  scene.latticeOfTextureZero = -textureOfLatticeZero / texturePerCell;
}

void cropBox(const Grid& grid, const ValueLayout& layout, const double planes[6], glm::dvec3& low,
  glm::dvec3& high)
{
  const auto textureFromPlane = [&](const glm::dvec3& plane) {
    return (plane - grid.origin) / grid.spacing * layout.textureFromGrid + layout.textureOfGridZero;
  };
  low = textureFromPlane({ planes[0], planes[2], planes[4] });
  high = textureFromPlane({ planes[1], planes[3], planes[5] });
}

void describeView(vtkRenderer* renderer, vtkVolume* volume, const Grid& grid,
  const ValueLayout& layout, RayCastScene& scene)
{
  scene.clipFromWorld = clipFromWorld(renderer);
  scene.worldFromTexture = worldFromTexture(grid, layout, volume->GetMatrix());
  scene.mmFromTexture = grid.spacing / layout.textureFromGrid;
  scene.lights = lightsOf(renderer);
  const int* tiles = renderer->GetRenderWindow()->GetTileScale();
  scene.tile = tiles[0] * tiles[1] > 1;
}

namespace
{
// Where points (texture coordinates) are seen in the image.
class SeenPoints
{
public:
  explicit SeenPoints(const RayCastScene& scene)
    : ClipFromTexture(scene.clipFromWorld * scene.worldFromTexture)
    , Size(scene.size)
  {
  }

  // False if it lies behind the eye.
  bool add(const glm::dvec3& point)
  {
    const glm::dvec4 clip = this->ClipFromTexture * glm::dvec4(point, 1.0);
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
    const glm::dvec2 far(1 << 20); // beyond any picture
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
  glm::dmat4 ClipFromTexture;
  glm::dvec2 Size;
};
}

PixelPart pixelsBetween(const std::vector<glm::vec3>& positions, const glm::dvec3& spaceLow,
  const glm::dvec3& spaceHigh, const RayCastScene& scene)
{
  SeenPoints seen(scene);
  for (const glm::vec3& position : positions)
  {
    const glm::dvec3 texture =
      (glm::dvec3(position) - scene.latticeOfTextureZero) / scene.latticeFromTexture;
    if (!seen.add(glm::clamp(texture, spaceLow, spaceHigh)))
    {
      return partOf({ glm::ivec2(0), scene.size });
    }
  }
  return positions.empty() ? PixelPart() : seen.around();
}

void placeShownPixels(const std::vector<IndexBox>& boxes, RayCastScene& scene)
{
  scene.shown = { glm::ivec2(0), boxes.empty() ? glm::ivec2(0) : scene.size };
  SeenPoints seen(scene);
  IndexBox bricks;
  for (const IndexBox& box : boxes)
  {
    bricks = enclosing(bricks, box);
    for (int corner = 0; corner < 8; ++corner)
    {
      const glm::ivec3 side(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
      const glm::dvec3 brick(box.first + side * box.size());
      if (!seen.add((scene.firstBrick + brick) * scene.textureFromBrick + scene.textureOfBrickZero))
      {
        return;
      }
    }
  }
  if (boxes.empty())
  {
    return;
  }
  // From wherever it is seen, the picture is about as long as the box's middle side or longer; of
  // tissue that lies aslant, seen along its length, shorter: then less is skipped than could be.
  const glm::ivec3 side = bricks.size() * BrickSide;
  const int longest = glm::max(side.x, glm::max(side.y, side.z));
  const int shortest = glm::min(side.x, glm::min(side.y, side.z));
  const int middle = side.x + side.y + side.z - longest - shortest;
  const double pixels = glm::max(seen.high.x - seen.low.x, seen.high.y - seen.low.y);
  scene.skipping = scene.skipping && pixels * LargestPixel > middle;
  scene.shown = seen.around().box;
}

void placeBricks(const ValueLayout& layout, RayCastScene& scene, PresenceRequest& request)
{
  // Bricks count voxels from the middle of the first one.
  const glm::dvec3 values(layout.dimensions);
  const double side = BrickSide;
  const auto voxelFromTexture = [&](const glm::dvec3& texture) { return texture * values - 0.5; };
  const glm::ivec3 first(glm::floor(voxelFromTexture(scene.spaceLow) / side));
  const glm::ivec3 end(glm::floor(voxelFromTexture(scene.spaceHigh) / side) + 1.0);
  scene.textureFromBrick = side / values;
  scene.textureOfBrickZero = 0.5 / values;
  scene.firstBrick = glm::dvec3(first);

  request.restBricks = (layout.dimensions + RestBrickSide - 1) / RestBrickSide;
  request.first = first;
  request.count = end - first;
  request.lowestVoxel = glm::vec3(voxelFromTexture(layout.low));
  request.highestVoxel = glm::vec3(voxelFromTexture(layout.high));
  request.offsets = scene.offsets;
  if (request.offsets)
  {
    const glm::dvec3 count(
      request.offsets->GetWidth(), request.offsets->GetHeight(), request.offsets->GetDepth());
    request.voxelsFromOffset = glm::vec3(values);
    request.nodesFromVoxel = glm::vec3(scene.fieldFromTexture * count / values);
    request.nodesFromVoxelShift = glm::vec3(
      (0.5 / values * scene.fieldFromTexture + scene.fieldFromTextureShift) * count - 0.5);
  }
}
}

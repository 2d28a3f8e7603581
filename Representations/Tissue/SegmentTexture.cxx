// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Tissue/SegmentTexture.h"

#include "Filters/Deformation/SegmentFractions.h"
#include "Representations/Gpu/GpuMemory.h"
#include "Representations/Gpu/OpenGL.h"
#include "Representations/Scene/SceneGeometry.h"

#include "vtkImageData.h"
#include "vtkOpenGLRenderWindow.h"

namespace brainshift
{
namespace
{
std::string noVoxel(const std::vector<int>& labels)
{
  std::string sentence = "Draw Segment is on, but no voxel of the segmentation is ";
  for (std::size_t i = 0; i < labels.size(); ++i)
  {
    sentence += (i ? " or " : "of label ") + std::to_string(labels[i]);
  }
  return sentence + (labels.empty() ? "above 0" : "") + ": nothing is drawn";
}

// Along one axis: whether any of the values that a brick's interpolation takes in is set.
std::vector<char> anyAlong(const std::vector<char>& values, glm::ivec3& side, int axis)
{
  const glm::ivec3 before = side;
  side[axis] = (side[axis] + RestBrickSide - 1) / RestBrickSide;
  const std::size_t stride = axis == 0 ? 1
    : axis == 1                        ? before.x
                                       : static_cast<std::size_t>(before.x) * before.y;
  std::vector<char> any(static_cast<std::size_t>(side.x) * side.y * side.z);
  parallelFor(0, side.z, 1, [&](vtkIdType begin, vtkIdType end) {
    std::size_t at = begin * static_cast<std::size_t>(side.x) * side.y;
    glm::ivec3 brick;
    for (brick.z = static_cast<int>(begin); brick.z < end; ++brick.z)
    {
      for (brick.y = 0; brick.y < side.y; ++brick.y)
      {
        for (brick.x = 0; brick.x < side.x; ++brick.x, ++at)
        {
          glm::ivec3 voxel = brick;
          voxel[axis] = 0;
          const char* row =
            &values[(static_cast<std::size_t>(voxel.z) * before.y + voxel.y) * before.x + voxel.x];
          const int first = std::max(brick[axis] * RestBrickSide - 1, 0);
          const int last =
            std::min(brick[axis] * RestBrickSide + RestBrickSide + 1, before[axis] - 1);
          for (int i = first; i <= last; ++i)
          {
            any[at] |= row[i * stride];
          }
        }
      }
    }
  });
  return any;
}
}

Grid gridOfTexels(const Grid& grid, const ValueLayout& layout)
{
  const glm::dvec3 first =
    (0.5 / glm::dvec3(layout.dimensions) - layout.textureOfGridZero) / layout.textureFromGrid;
  Grid texels = grid;
  texels.dimensions = layout.dimensions;
  texels.origin = grid.worldFromGrid(first);
  texels.spacing *= glm::dvec3(layout.perTexel);
  return texels;
}

SegmentRequest requestSegment(
  vtkImageData* volume, const std::vector<int>& asked, std::string& remark)
{
  SegmentRequest request;
  request.segmentation = readSegmentation(volume);
  if (!request.segmentation.labels)
  {
    remark = "Draw Segment is on, but the volume carries no segmentation: give Free-Form "
             "Deformation a Mask or a Segmentation. All tissue is drawn";
    return request;
  }
  request.chosen = asked.empty() ? request.segmentation.chosen : asked;
  return request;
}

BrickRanges rangesWithin(const BrickRanges& bricks, const std::vector<char>& reaching)
{
  const glm::vec2 none(1.0f, -1.0f);
  BrickRanges within = bricks;
  for (std::size_t brick = 0; brick < reaching.size(); ++brick)
  {
    within.ranges[brick] = reaching[brick] ? bricks.ranges[brick] : none;
  }
  return within;
}

std::vector<char> bricksReaching(
  const std::vector<std::uint8_t>& fractions, const glm::ivec3& dimensions)
{
  std::vector<char> reaching(fractions.size());
  std::transform(fractions.begin(), fractions.end(), reaching.begin(), [](std::uint8_t fraction) {
    return static_cast<char>(fraction > LeastFraction * WholeFraction);
  });
  glm::ivec3 side = dimensions;
  for (int axis = 0; axis < 3; ++axis)
  {
    reaching = anyAlong(reaching, side, axis);
  }
  return reaching;
}

vtkSmartPointer<vtkTextureObject> fractionTexture(vtkOpenGLRenderWindow* window,
  std::vector<std::uint8_t> fractions, const glm::ivec3& side, Counters& counters)
{
  auto texture = vtkSmartPointer<vtkTextureObject>::New();
  texture->SetContext(window);
  texture->SetMinificationFilter(vtkTextureObject::Linear);
  texture->SetMagnificationFilter(vtkTextureObject::Linear);
  texture->SetInternalFormat(drawsInSoftware() ? GL_R32F : GL_R8); // as of the scalars
  texture->SetWrapS(vtkTextureObject::ClampToEdge);
  texture->SetWrapT(vtkTextureObject::ClampToEdge);
  texture->SetWrapR(vtkTextureObject::ClampToEdge);
  counters.segmentUploads += 1;
  counters.bytesUploaded += static_cast<std::int64_t>(fractions.size());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  const bool made =
    texture->Create3DFromRaw(side.x, side.y, side.z, 1, VTK_UNSIGNED_CHAR, fractions.data());
  return made ? texture : nullptr;
}

SegmentTexture::SegmentTexture() = default;
SegmentTexture::~SegmentTexture() = default;

int SegmentTexture::bytesOfVoxel()
{
  return drawsInSoftware() ? 4 : 1;
}

bool SegmentTexture::holds(const SegmentRequest& request, const Grid& texels) const
{
  const Segmentation& asked = request.segmentation;
  return this->Texture && this->Uploaded.segmentation.labels == asked.labels &&
    this->UploadedTime == asked.labels->GetMTime() &&
    this->Uploaded.segmentation.grid == asked.grid && this->Uploaded.chosen == request.chosen &&
    this->Texels == texels;
}

bool SegmentTexture::update(
  GpuTask& gpu, const SegmentRequest& request, const Grid& texels, bool& changed)
{
  if (!request.segmentation.labels)
  {
    changed = this->Texture != nullptr;
    this->releaseGraphicsResources(gpu.window);
    return true;
  }
  changed = !this->holds(request, texels);
  if (!changed)
  {
    return true;
  }
  const Mask segment = segmentOf(request.segmentation, request.chosen);
  const bool any =
    std::find(segment.inside.begin(), segment.inside.end(), 1) != segment.inside.end();
  this->Remark = any ? std::string() : noVoxel(request.chosen);
  std::vector<std::uint8_t> fractions = segmentFractions(segment, texels);
  const glm::ivec3& side = texels.dimensions;
  this->Reaching = bricksReaching(fractions, side);
  this->Texture = fractionTexture(gpu.window, std::move(fractions), side, gpu.counters);
  if (!this->Texture)
  {
    return false;
  }
  this->Uploaded = request;
  this->Texels = texels;
  this->UploadedTime = request.segmentation.labels->GetMTime();
  return true;
}

void SegmentTexture::releaseGraphicsResources(vtkWindow* window)
{
  if (this->Texture)
  {
    this->Texture->ReleaseGraphicsResources(window);
  }
  this->Texture = nullptr;
  this->Uploaded = SegmentRequest();
  this->Remark.clear();
}
}

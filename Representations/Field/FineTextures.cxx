// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Field/FineTextures.h"

#include "Representations/Gpu/OpenGL.h"
#include "Representations/Gpu/VolumePass.h"

#include "vtkOpenGLRenderWindow.h"

#include <algorithm>

namespace brainshift
{
namespace
{
NodeBlock blockOf(
  const IndexBox& nodes, const std::vector<glm::vec4>& texels, const glm::vec3& scale)
{
  NodeBlock block;
  block.nodes = nodes;
  block.offsets.reserve(texels.size());
  for (const glm::vec4& texel : texels)
  {
    block.offsets.push_back(glm::vec3(texel) / scale);
  }
  return block;
}

// Layers of slots that a texture is made for, so that it is not made anew for each few slots.
int roomFor(int layers)
{
  int room = 1;
  while (room < layers)
  {
    room *= 2;
  }
  return room;
}
}

void FineTextures::reset(const FieldNodes& nodes)
{
  this->Fine.reset(nodes);
  this->Codes = nullptr;
  this->Corrections = nullptr;
}

void FineTextures::leaveOut(const IndexBox& changedNodes)
{
  const IndexBox cells = this->Fine.cellsAround(changedNodes);
  if (this->Codes && !cells.empty())
  {
    this->Fine.leaveOut(cells);
    Counters uncounted; // zeros
    this->uploadCodes(cells, uncounted);
  }
}

bool FineTextures::correct(vtkOpenGLRenderWindow* window, const DrawnOffsets& offsets,
  const Accuracy& accuracy, const IndexBox& changedNodes, Counters& counters)
{
  bool done = this->correctAround(window, offsets, accuracy, changedNodes, counters);
  if (done && this->LeftOut && this->Fine.isScattered())
  {
    this->Fine.reset(offsets.nodes);
    const IndexBox all{ glm::ivec3(0), offsets.nodes.count - 1 };
    done = this->correctAround(window, offsets, accuracy, all, counters);
  }
  if (!done)
  {
    this->reset(offsets.nodes);
  }
  return done;
}

// A layer of cells after the other, in parts, because what is read takes memory.
bool FineTextures::correctAround(vtkOpenGLRenderWindow* window, const DrawnOffsets& offsets,
  const Accuracy& accuracy, const IndexBox& changedNodes, Counters& counters)
{
  constexpr std::int64_t mostCells = std::int64_t(1) << 21;
  const IndexBox cells = this->Fine.cellsAround(changedNodes);
  this->Written = cells.empty() ? IndexBox() : IndexBox{ cells.first, cells.last + 1 };
  this->LeftOut = false;
  const glm::ivec3 size = cells.size();
  const std::int64_t layer = std::max<std::int64_t>(std::int64_t(size.x) * size.y, 1);
  const int layers = static_cast<int>(std::max<std::int64_t>(mostCells / layer, 1));
  for (int first = cells.first.z; first <= cells.last.z; first += layers)
  {
    const int last = std::min(first + layers - 1, cells.last.z);
    const IndexBox some{ { cells.first.x, cells.first.y, first },
      { cells.last.x, cells.last.y, last } };
    if (!this->correctSome(window, offsets, accuracy, some, counters))
    {
      return false;
    }
    this->LeftOut = this->LeftOut || this->Fine.leftOut();
  }
  return !this->Codes || this->uploadCorrections(window, counters);
}

bool FineTextures::correctSome(vtkOpenGLRenderWindow* window, const DrawnOffsets& offsets,
  const Accuracy& accuracy, const IndexBox& cells, Counters& counters)
{
  const IndexBox read = this->Fine.nodesToRead(cells);
  const std::vector<glm::vec4> texels =
    readVolume(window, offsets.texture, read.first, read.size());
  this->Fine.find(cells, blockOf(read, texels, offsets.scale), accuracy);
  if (!this->Fine.any() && !this->Codes)
  {
    return true;
  }
  if (!this->Codes && !this->makeCodes(window, offsets.nodes.count))
  {
    return false;
  }
  this->uploadCodes(cells, counters);
  this->uploadReaches(offsets, read, texels, cells, counters);
  return true;
}

bool FineTextures::makeCodes(vtkOpenGLRenderWindow* window, const glm::ivec3& count)
{
  this->Codes = makeTexture(window, GL_R32F, vtkTextureObject::Nearest);
  if (!this->Codes->Allocate3D(count.x, count.y, count.z, 1, VTK_FLOAT))
  {
    this->Codes = nullptr;
    return false;
  }
  clearVolume(window, this->Codes);
  return true;
}

void FineTextures::uploadCodes(const IndexBox& cells, Counters& counters)
{
  const std::vector<float> codes = this->Fine.codes(cells);
  replaceTexels(this->Codes, { cells, GL_RED, GL_FLOAT, codes.data() });
  counters.correctionBytes += static_cast<std::int64_t>(codes.size() * sizeof(float));
}

// The offsets go back as they were read from some nodes.
void FineTextures::uploadReaches(const DrawnOffsets& offsets, const IndexBox& nodes,
  const std::vector<glm::vec4>& texels, const IndexBox& cells, Counters& counters)
{
  const IndexBox corners{ cells.first, cells.last + 1 };
  const std::vector<float> reaches = this->Fine.reaches(corners);
  const glm::ivec3 size = nodes.size();
  std::vector<glm::vec4> marked;
  marked.reserve(reaches.size());
  forEachIndex(corners.first, corners.last, [&](const glm::ivec3& node) {
    const glm::ivec3 at = node - nodes.first;
    const glm::vec4& read =
      texels[(static_cast<std::size_t>(at.z) * size.y + at.y) * size.x + at.x];
    marked.emplace_back(glm::vec3(read), reaches[marked.size()]);
  });
  replaceTexels(offsets.texture, { corners, GL_RGBA, GL_FLOAT, marked.data() });
  counters.correctionBytes += static_cast<std::int64_t>(marked.size() * sizeof(glm::vec4));
}

// A texture of zeros that holds all layers of slots. The filter reads beyond a slot with a weight
// of zero, and zero times what is no number is no number.
bool FineTextures::makeRoom(vtkOpenGLRenderWindow* window)
{
  this->Corrections = makeTexture(window, GL_RGBA16F, vtkTextureObject::Linear);
  const bool made = this->Corrections->Allocate3D(SlotSide * SlotsInRow, SlotSide * RowsInLayer,
    SlotSide * roomFor(std::max(this->Fine.layers(), 1)), 4, VTK_FLOAT);
  if (!made)
  {
    this->Corrections = nullptr;
    return false;
  }
  clearVolume(window, this->Corrections);
  return true;
}

bool FineTextures::uploadCorrections(vtkOpenGLRenderWindow* window, Counters& counters)
{
  std::array<int, 2> slots = this->Fine.takeWritten();
  const int needed = SlotSide * this->Fine.layers();
  if (!this->Corrections || static_cast<int>(this->Corrections->GetDepth()) < needed)
  {
    slots = { 0, this->Fine.layers() * SlotsInLayer - 1 };
    if (!this->makeRoom(window))
    {
      return false;
    }
  }
  // Whole rows of one layer at a time.
  for (int row = slots[0] / SlotsInRow; row * SlotsInRow <= slots[1];)
  {
    const int layer = row / RowsInLayer;
    const int last = std::min(slots[1] / SlotsInRow, (layer + 1) * RowsInLayer - 1);
    const IndexBox box{ { 0, SlotSide * (row % RowsInLayer), SlotSide * layer },
      { SlotSide * SlotsInRow - 1, SlotSide * (last % RowsInLayer) + SlotSide - 1,
        SlotSide * layer + SlotSide - 1 } };
    const std::vector<std::uint64_t> texels = this->Fine.texels(box);
    replaceTexels(this->Corrections, { box, GL_RGBA, GL_HALF_FLOAT, texels.data() });
    counters.correctionBytes += static_cast<std::int64_t>(texels.size() * sizeof(std::uint64_t));
    row = last + 1;
  }
  return true;
}

std::int64_t FineTextures::bytes() const
{
  const auto texels = [](vtkTextureObject* texture) {
    return texture
      ? static_cast<std::int64_t>(texture->GetWidth()) * texture->GetHeight() * texture->GetDepth()
      : 0;
  };
  constexpr std::int64_t codeBytes = 4;
  constexpr std::int64_t correctionBytes = 8;
  return codeBytes * texels(this->Codes) + correctionBytes * texels(this->Corrections);
}

void FineTextures::releaseGraphicsResources(vtkWindow* window)
{
  for (vtkTextureObject* texture : this->textures())
  {
    if (texture)
    {
      texture->ReleaseGraphicsResources(window);
    }
  }
  this->reset(FieldNodes());
}
}

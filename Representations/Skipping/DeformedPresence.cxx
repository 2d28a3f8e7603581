// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Skipping/DeformedPresence.h"

#include "Representations/Gpu/OpenGL.h"
#include "Representations/Gpu/VolumePass.h"

#include "vtkOpenGLBufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkShaderProgram.h"

namespace brainshift
{
namespace
{
// Rectangles overlap by so many bricks, which is a sixteenth of a voxel. Neighbours of different
// length have no corners in common, and the rasteriser would leave gaps where it rounds.
constexpr float RectangleOverlap = 1.0f / 64.0f;
constexpr int CornersPerRectangle = 6; // two triangles

void setFilter(vtkTextureObject* texture, int filter)
{
  texture->SetMinificationFilter(filter);
  texture->SetMagnificationFilter(filter);
}

void setNearest(vtkTextureObject* texture)
{
  setFilter(texture, vtkTextureObject::Nearest);
  texture->SetWrapS(vtkTextureObject::ClampToEdge);
  texture->SetWrapT(vtkTextureObject::ClampToEdge);
  texture->SetWrapR(vtkTextureObject::ClampToEdge);
}

// Whether two requests differ in nothing but the values of the offsets.
bool samePlaces(const PresenceRequest& a, const PresenceRequest& b)
{
  return a.first == b.first && a.count == b.count && a.restBricks == b.restBricks &&
    a.lowestVoxel == b.lowestVoxel && a.highestVoxel == b.highestVoxel &&
    (a.offsets == nullptr) == (b.offsets == nullptr) && a.voxelsFromOffset == b.voxelsFromOffset &&
    a.voxelsFromLattice == b.voxelsFromLattice && a.nodesFromVoxel == b.nodesFromVoxel &&
    a.nodesFromVoxelShift == b.nodesFromVoxelShift;
}

// Bricks whose offsets depend on a box of nodes.
IndexBox bricksOfNodes(const PresenceRequest& request, const IndexBox& nodes)
{
  if (nodes.empty())
  {
    return {};
  }
  const auto brickOfNode = [&](const glm::ivec3& node) {
    const glm::vec3 voxel =
      (glm::vec3(node) - request.nodesFromVoxelShift) / request.nodesFromVoxel;
    return glm::ivec3(glm::floor(voxel / static_cast<float>(BrickSide))) - request.first;
  };
  // A brick also reads the nodes just beyond its margin. Nodes at the end of the field represent
  // everything beyond it.
  IndexBox box{ glm::max(brickOfNode(nodes.first - 1) - 1, glm::ivec3(0)),
    glm::min(brickOfNode(nodes.last + 1) + 1, request.count - 1) };
  const glm::ivec3 lastNode(request.offsets->GetWidth() - 1, request.offsets->GetHeight() - 1,
    request.offsets->GetDepth() - 1);
  for (int axis = 0; axis < 3; ++axis)
  {
    box.first[axis] = nodes.first[axis] <= 0 ? 0 : box.first[axis];
    box.last[axis] = nodes.last[axis] >= lastNode[axis] ? request.count[axis] - 1 : box.last[axis];
  }
  return box;
}

IndexBox blocksOf(const IndexBox& bricks)
{
  return { bricks.first / BricksInBlock, bricks.last / BricksInBlock };
}

// How far a box is moved along x in its texture, which is read at once and not kept.
glm::ivec3 shiftOf(const IndexBox& box)
{
  return { leadToSecondThread(box.first.x, box.size().x), 0, 0 };
}

glm::ivec3 blockShift(const IndexBox& bricks)
{
  return shiftOf(blocksOf(bricks));
}

// Corners of a rectangle's two triangles, in bricks from the volume's first voxel.
void appendRectangle(
  std::vector<glm::vec3>& corners, const BrickRectangle& rectangle, const glm::ivec3& first)
{
  glm::vec3 margin(RectangleOverlap);
  margin[rectangle.axis] = 0.0f;
  const glm::vec3 low = glm::vec3(first + rectangle.low) - margin;
  const glm::vec3 high = glm::vec3(first + rectangle.high) + margin;
  const int along = (rectangle.axis + 1) % 3;
  glm::vec3 lowHigh = low;
  glm::vec3 highLow = high;
  lowHigh[along] = high[along];
  highLow[along] = low[along];
  corners.insert(corners.end(), { low, lowHigh, high, low, high, highLow });
}
}

DeformedPresence::DeformedPresence() = default;
DeformedPresence::~DeformedPresence() = default;

bool DeformedPresence::setVisibility(vtkOpenGLRenderWindow* window, const glm::ivec3& restBricks,
  std::vector<float>& summed, Counters& counters)
{
  this->Summed = vtkSmartPointer<vtkTextureObject>::New();
  this->Summed->SetContext(window);
  setNearest(this->Summed);
  this->AllNew = true;
  counters.bytesUploaded += static_cast<std::int64_t>(summed.size() * sizeof(float));
  return this->Summed->Create3DFromRaw(
    restBricks.x + 1, restBricks.y + 1, restBricks.z + 1, 1, VTK_FLOAT, summed.data());
}

bool DeformedPresence::allocate(vtkOpenGLRenderWindow* window, const glm::ivec3& count)
{
  const auto make = [&](vtkSmartPointer<vtkTextureObject>& map, const glm::ivec3& side,
                      int components, int type) {
    map = vtkSmartPointer<vtkTextureObject>::New();
    map->SetContext(window);
    setNearest(map);
    return map->Allocate3D(side.x, side.y, side.z, components, type);
  };
  glm::ivec3 blocks = (count + BricksInBlock - 1) / BricksInBlock;
  const glm::ivec3 lead(leadToSecondThread(0, 0), 0, 0); // at most
  blocks += lead;
  if (make(this->Blocks[0], blocks, 4, VTK_FLOAT) && make(this->Blocks[1], blocks, 4, VTK_FLOAT) &&
    make(this->Map, count + lead, 1, VTK_UNSIGNED_CHAR))
  {
    this->Occupied.assign(static_cast<std::size_t>(count.x) * count.y * count.z, 0);
    return true;
  }
  this->Map = nullptr;
  return false;
}

// The uniforms of Shaders/Skipping/bricks.glsl.
void DeformedPresence::setBricks(Program& program, const PresenceRequest& request)
{
  program.set("brickSide", static_cast<float>(BrickSide));
  program.set("firstBrick", request.first);
  program.set("margin", BrickMargin);
  if (request.offsets)
  {
    program.set("offsets", request.offsets);
    program.set("offsetCount",
      glm::ivec3(
        request.offsets->GetWidth(), request.offsets->GetHeight(), request.offsets->GetDepth()));
    program.set("voxelsFromOffset", request.voxelsFromOffset);
    program.set("voxelsFromLattice", request.voxelsFromLattice);
    program.set("nodesFromVoxel", request.nodesFromVoxel);
    program.set("nodesFromVoxelShift", request.nodesFromVoxelShift);
  }
}

bool DeformedPresence::findBlocks(vtkOpenGLRenderWindow* window, const PresenceRequest& request,
  const IndexBox& box, Counters& counters)
{
  if (!this->BlocksProgram.use(window, blocksSource(), counters))
  {
    return false;
  }
  this->setBricks(this->BlocksProgram, request);
  const IndexBox blocks = blocksOf(box);
  const glm::ivec3 shift = blockShift(box);
  this->BlocksProgram.set("blockShift", glm::vec3(shift));
  runVolumePass(window, this->BlocksProgram.get()->GetHandle(),
    { this->Blocks[0], this->Blocks[1] }, blocks.first + shift, blocks.size());
  request.offsets->Deactivate();
  return true;
}

bool DeformedPresence::compute(vtkOpenGLRenderWindow* window, const PresenceRequest& request,
  const IndexBox& box, Counters& counters)
{
  const bool deformed = request.offsets != nullptr;
  if (deformed)
  {
    setFilter(request.offsets, vtkTextureObject::Nearest);
  }
  Program& program = this->MapPrograms[deformed];
  if ((deformed && !this->findBlocks(window, request, box, counters)) ||
    !program.use(window, presenceSource(deformed), counters))
  {
    return false;
  }
  this->setBricks(program, request);
  program.set("summed", this->Summed.Get());
  program.set("restBricks", request.restBricks);
  program.set("restBrickSide", static_cast<float>(RestBrickSide));
  program.set("lowestVoxel", request.lowestVoxel);
  program.set("highestVoxel", request.highestVoxel);
  if (deformed)
  {
    program.set("blocks",
      glm::ivec3(
        this->Blocks[0]->GetWidth(), this->Blocks[0]->GetHeight(), this->Blocks[0]->GetDepth()));
    program.set("blockShift", glm::vec3(blockShift(box)));
    program.set("blockLeast", this->Blocks[0].Get());
    program.set("blockGreatest", this->Blocks[1].Get());
  }
  const glm::ivec3 shift = shiftOf(box);
  program.set("mapShift", glm::vec3(shift));
  runVolumePass(window, program.get()->GetHandle(), { this->Map }, box.first + shift, box.size());
  for (vtkTextureObject* texture :
    { this->Summed.Get(), this->Blocks[0].Get(), this->Blocks[1].Get(), request.offsets })
  {
    if (texture)
    {
      texture->Deactivate();
    }
  }
  if (deformed)
  {
    setFilter(request.offsets, vtkTextureObject::Linear);
  }
  return true;
}

bool DeformedPresence::update(vtkOpenGLRenderWindow* window, const PresenceRequest& request,
  const IndexBox& changed, Counters& counters)
{
  IndexBox box{ glm::ivec3(0), request.count - 1 };
  bool known = false; // which bricks were occupied
  if (!this->Map || this->Known.count != request.count)
  {
    if (!this->allocate(window, request.count))
    {
      return false;
    }
    this->Known.count = request.count;
  }
  else if (!this->Failed && samePlaces(this->Known, request))
  {
    known = true;
    box = this->AllNew ? box : bricksOfNodes(request, changed);
    if (box.empty())
    {
      return true;
    }
  }
  this->Failed = true; // until all of it succeeded
  if (!this->compute(window, request, box, counters))
  {
    return false;
  }
  if (this->readMap(request, box) || !known)
  {
    this->makeFaces(request);
    if (!this->makeLeaps(window, request))
    {
      return false;
    }
    counters.skippingBytes += static_cast<std::int64_t>(this->Occupied.size()) + this->faceBytes();
  }
  counters.presenceUpdates += 1;
  this->Known = request;
  this->AllNew = this->Failed = false;
  return true;
}

// One byte of each brick comes back, once for an edit and never for a camera move. Making the faces
// on the GPU would cost its geometry stage in every frame, and distances would take many passes.
// Returns whether any brick changed: half the pictures of a slow drag fill or empty none.
bool DeformedPresence::readMap(const PresenceRequest& request, const IndexBox& box)
{
  const glm::ivec3 held(this->Map->GetWidth(), this->Map->GetHeight(), this->Map->GetDepth());
  std::vector<std::uint8_t> map(static_cast<std::size_t>(held.x) * held.y * held.z);
  this->Map->Activate();
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glGetTexImage(GL_TEXTURE_3D, 0, GL_RED, GL_UNSIGNED_BYTE, map.data());
  this->Map->Deactivate();
  const auto placeIn = [](const glm::ivec3& size, const glm::ivec3& at) {
    return (static_cast<std::size_t>(at.z) * size.y + at.y) * size.x + at.x;
  };
  bool changed = false;
  glm::ivec3 row = box.first;
  for (row.z = box.first.z; row.z <= box.last.z; ++row.z)
  {
    for (row.y = box.first.y; row.y <= box.last.y; ++row.y)
    {
      const auto read = map.begin() + placeIn(held, row + shiftOf(box));
      const auto known = this->Occupied.begin() + placeIn(request.count, row);
      changed = changed || !std::equal(read, read + box.size().x, known);
      std::copy_n(read, box.size().x, known);
    }
  }
  return changed;
}

bool DeformedPresence::makeLeaps(vtkOpenGLRenderWindow* window, const PresenceRequest& request)
{
  std::vector<std::uint8_t> distances = bricksToOccupied(this->Occupied, request.count);
  this->Leaps = vtkSmartPointer<vtkTextureObject>::New();
  this->Leaps->SetContext(window);
  setNearest(this->Leaps);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  return this->Leaps->Create3DFromRaw(
    request.count.x, request.count.y, request.count.z, 1, VTK_UNSIGNED_CHAR, distances.data());
}

void DeformedPresence::makeFaces(const PresenceRequest& request)
{
  std::vector<glm::vec3> corners;
  this->Faces = brickFaces(this->Occupied, request.count);
  for (const BrickFaces& faces : this->Faces)
  {
    for (const BrickRectangle& rectangle : faces.rectangles)
    {
      appendRectangle(corners, rectangle, request.first);
    }
  }
  this->OccupiedLayers = brainshift::occupiedLayers(this->Faces, request.count.z);
  this->OccupiedBox = IndexBox();
  for (const IndexBox& layer : this->OccupiedLayers)
  {
    this->OccupiedBox = enclosing(this->OccupiedBox, layer);
  }
  if (!this->Corners)
  {
    this->Corners = vtkSmartPointer<vtkOpenGLBufferObject>::New();
  }
  if (!corners.empty())
  {
    this->Corners->Upload(corners.data(), corners.size(), vtkOpenGLBufferObject::ArrayBuffer);
  }
}

void DeformedPresence::drawFaces(int programHandle)
{
  int all = 0;
  for (const BrickFaces& faces : this->Faces)
  {
    all += static_cast<int>(faces.rectangles.size());
  }
  this->drawRectangles(programHandle, { { 0, all } });
}

void DeformedPresence::drawFaces(int programHandle, const glm::dvec4& eye)
{
  std::vector<std::pair<int, int>> ranges;
  int before = 0;
  for (const BrickFaces& faces : this->Faces)
  {
    const auto [first, last] = facing(faces, this->fromFirstBrick(eye));
    ranges.emplace_back(before + first, before + last);
    before += static_cast<int>(faces.rectangles.size());
  }
  this->drawRectangles(programHandle, ranges);
}

bool DeformedPresence::isOutside(const glm::dvec4& eye) const
{
  if (eye.w == 0.0)
  {
    return true;
  }
  const glm::dvec3 place = glm::dvec3(this->fromFirstBrick(eye)) / eye.w;
  return glm::any(glm::lessThan(place, glm::dvec3(this->OccupiedBox.first))) ||
    glm::any(glm::greaterThan(place, glm::dvec3(this->OccupiedBox.last + 1)));
}

glm::dvec4 DeformedPresence::fromFirstBrick(const glm::dvec4& eye) const
{
  return glm::dvec4(glm::dvec3(eye) - eye.w * glm::dvec3(this->Known.first), eye.w);
}

// `ranges`: first rectangle, and one past the last.
void DeformedPresence::drawRectangles(
  int programHandle, const std::vector<std::pair<int, int>>& ranges)
{
  if (!this->Corners || this->faceBytes() == 0)
  {
    return;
  }
  GLuint vertexArray = 0;
  glGenVertexArrays(1, &vertexArray);
  glBindVertexArray(vertexArray);
  this->Corners->Bind();
  const GLint corner = glGetAttribLocation(programHandle, "corner");
  glEnableVertexAttribArray(corner);
  glVertexAttribPointer(corner, 3, GL_FLOAT, GL_FALSE, sizeof(glm::vec3), nullptr);
  for (const auto& [first, last] : ranges)
  {
    glDrawArrays(GL_TRIANGLES, CornersPerRectangle * first, CornersPerRectangle * (last - first));
  }
  this->Corners->Release();
  glBindVertexArray(0);
  glDeleteVertexArrays(1, &vertexArray);
}

std::int64_t DeformedPresence::faceBytes() const
{
  std::int64_t rectangles = 0;
  for (const BrickFaces& faces : this->Faces)
  {
    rectangles += static_cast<std::int64_t>(faces.rectangles.size());
  }
  return rectangles * CornersPerRectangle * static_cast<std::int64_t>(sizeof(glm::vec3));
}

void DeformedPresence::releaseGraphicsResources(vtkWindow* window)
{
  for (vtkTextureObject* texture : this->textures())
  {
    if (texture)
    {
      texture->ReleaseGraphicsResources(window);
    }
  }
  if (this->Corners)
  {
    this->Corners->ReleaseGraphicsResources();
  }
  this->Summed = nullptr;
  this->Map = nullptr;
  this->Leaps = nullptr;
  this->Blocks[0] = nullptr;
  this->Blocks[1] = nullptr;
  this->Corners = nullptr;
  this->BlocksProgram.forget();
  this->MapPrograms[0].forget();
  this->MapPrograms[1].forget();
}

namespace
{
// Lowers `to` to the greater of `away` and the element of `from` that lies `away` elements further
// on.
void lower(std::uint8_t* to, const std::uint8_t* from, std::uint8_t away, std::size_t count)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    to[i] = std::min(to[i], std::max(from[i], away));
  }
}

// Distances along one axis, whose `length` elements lie `stride` apart in each of `blocks` blocks.
// The maximum norm can be computed axis by axis.
std::vector<std::uint8_t> alongAxis(
  const std::vector<std::uint8_t>& from, int length, std::size_t stride, std::size_t blocks)
{
  std::vector<std::uint8_t> to = from;
  const std::size_t block = stride * length;
  for (std::size_t b = 0; b < blocks; ++b)
  {
    for (int away = 1; away < std::min(LongestLeap, length); ++away)
    {
      const std::size_t shift = stride * away;
      const auto distance = static_cast<std::uint8_t>(away);
      lower(&to[b * block], &from[b * block + shift], distance, block - shift);
      lower(&to[b * block + shift], &from[b * block], distance, block - shift);
    }
  }
  return to;
}
}

std::vector<std::uint8_t> bricksToOccupied(
  const std::vector<std::uint8_t>& occupied, const glm::ivec3& count)
{
  std::vector<std::uint8_t> distance(occupied.size());
  std::transform(occupied.begin(), occupied.end(), distance.begin(),
    [](std::uint8_t there) { return static_cast<std::uint8_t>(there ? 0 : LongestLeap); });
  const std::size_t width = count.x;
  distance = alongAxis(distance, count.x, 1, static_cast<std::size_t>(count.y) * count.z);
  distance = alongAxis(distance, count.y, width, count.z);
  return alongAxis(distance, count.z, width * count.y, 1);
}
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Traces/TraceDrawer.h"

#include "Representations/Gpu/SceneScope.h"

#include "vtkOpenGLBufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkShaderProgram.h"

#include <glm/gtc/matrix_access.hpp>

#include <algorithm>

namespace brainshift
{
namespace
{
constexpr int Bits = 5; // 2^5 cells a side
constexpr int CellsASide = 1 << Bits;
constexpr std::size_t CellCount = std::size_t(1) << (3 * Bits);

glm::vec3 placeOf(const TraceVertex& vertex)
{
  return { vertex.position[0], vertex.position[1], vertex.position[2] };
}

// Number of a cell along the Z-curve: the bits of its three coordinates, interleaved (Morton, "A
// computer oriented geodetic data base and a new technique in file sequencing", IBM, 1966).
std::size_t numberOf(const glm::ivec3& cell)
{
  std::size_t number = 0;
  for (int bit = Bits - 1; bit >= 0; --bit)
  {
    for (int axis = 2; axis >= 0; --axis)
    {
      number = 2 * number + ((cell[axis] >> bit) & 1);
    }
  }
  return number;
}

std::vector<std::size_t> cellsOf(const std::vector<TraceVertex>& vertices)
{
  glm::vec3 low = placeOf(vertices.front());
  glm::vec3 high = low;
  for (const TraceVertex& vertex : vertices)
  {
    low = glm::min(low, placeOf(vertex));
    high = glm::max(high, placeOf(vertex));
  }
  const glm::vec3 extent = high - low;
  const float side = glm::max(glm::max(extent.x, extent.y), extent.z);
  const float cellsForMm = side > 0.0f ? CellsASide / side : 0.0f;
  std::vector<std::size_t> cells;
  cells.reserve(vertices.size());
  for (const TraceVertex& vertex : vertices)
  {
    const glm::ivec3 cell((placeOf(vertex) - low) * cellsForMm);
    cells.push_back(numberOf(glm::min(cell, glm::ivec3(CellsASide - 1))));
  }
  return cells;
}
}

std::vector<TraceVertex> sortedBySpace(const std::vector<TraceVertex>& vertices)
{
  if (vertices.empty())
  {
    return {};
  }
  const std::vector<std::size_t> cells = cellsOf(vertices);
  std::vector<std::size_t> places(CellCount + 1, 0); // of each cell's next point
  for (const std::size_t cell : cells)
  {
    ++places[cell + 1];
  }
  for (std::size_t cell = 0; cell < CellCount; ++cell)
  {
    places[cell + 1] += places[cell];
  }
  std::vector<TraceVertex> sorted(vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i)
  {
    sorted[places[cells[i]]++] = vertices[i];
  }
  return sorted;
}

TraceImage::TraceImage() = default;
TraceImage::~TraceImage() = default;

void TraceImage::provide(vtkOpenGLRenderWindow* window, const glm::ivec2& size)
{
  if (this->Colors)
  {
    this->Colors->Resize(size.x, size.y);
    this->Depths->Resize(size.x, size.y);
    return;
  }
  this->Colors = vtkSmartPointer<vtkTextureObject>::New();
  this->Depths = vtkSmartPointer<vtkTextureObject>::New();
  for (vtkTextureObject* image : { this->Colors.Get(), this->Depths.Get() })
  {
    image->SetContext(window);
    image->SetMinificationFilter(vtkTextureObject::Nearest);
    image->SetMagnificationFilter(vtkTextureObject::Nearest);
  }
  constexpr int components = 4;
  this->Colors->Allocate2D(size.x, size.y, components, VTK_UNSIGNED_CHAR);
  this->Depths->AllocateDepth(size.x, size.y, vtkTextureObject::Fixed32);
}

void TraceImage::draw(
  vtkOpenGLRenderWindow* window, const glm::ivec2& size, const std::function<void()>& drawBalls)
{
  this->provide(window, size);
  vtkOpenGLState* state = window->GetState();
  vtkOpenGLState::ScopedglViewport viewport(state);
  vtkOpenGLState::ScopedglScissor scissor(state);
  vtkOpenGLState::ScopedglEnableDisable blend(state, GL_BLEND);
  FramebufferScope framebuffer(state);
  glFramebufferTexture2D(
    GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, this->Colors->GetHandle(), 0);
  glFramebufferTexture2D(
    GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, this->Depths->GetHandle(), 0);
  framebuffer.drawColors(1);
  state->vtkglViewport(0, 0, size.x, size.y);
  state->vtkglScissor(0, 0, size.x, size.y);
  state->vtkglDisable(GL_BLEND);
  // The clear of VTK's state would change the clear colour of the window.
  const float nothing[4] = { 0.0f, 0.0f, 0.0f, 0.0f };
  const float farthest = 1.0f;
  glClearBufferfv(GL_COLOR, 0, nothing);
  glClearBufferfv(GL_DEPTH, 0, &farthest);
  drawBalls();
}

bool TraceImage::layOver(vtkOpenGLRenderWindow* window, Counters& counters)
{
  if (!this->OverProgram.use(window, tracesOverSource(), counters))
  {
    return false;
  }
  this->OverProgram.set("balls", this->Colors.Get());
  this->OverProgram.set("depths", this->Depths.Get());
  drawTriangles(1);
  this->Colors->Deactivate();
  this->Depths->Deactivate();
  return true;
}

void TraceImage::releaseGraphicsResources(vtkWindow* window)
{
  for (auto* image : { &this->Colors, &this->Depths })
  {
    if (*image)
    {
      (*image)->ReleaseGraphicsResources(window);
    }
    *image = nullptr;
  }
  this->OverProgram.forget();
}

namespace
{
// Lets the vertex shader choose the size of points. VTK's state does not know this setting.
class PointSizeScope
{
public:
  PointSizeScope() { glEnable(GL_PROGRAM_POINT_SIZE); }
  ~PointSizeScope() { glDisable(GL_PROGRAM_POINT_SIZE); }
  PointSizeScope(const PointSizeScope&) = delete;
  void operator=(const PointSizeScope&) = delete;
};

// A member of TraceVertex; bytes become 0 to 1.
struct Attribute
{
  const char* name;
  int size; // numbers
  GLenum type;
  std::size_t offset; // bytes
};

void enable(const Attribute& attribute, GLuint program)
{
  const GLint location = glGetAttribLocation(program, attribute.name);
  const GLboolean normalized = attribute.type == GL_UNSIGNED_BYTE ? GL_TRUE : GL_FALSE;
  glEnableVertexAttribArray(location);
  glVertexAttribPointer(location, attribute.size, attribute.type, normalized, sizeof(TraceVertex),
    reinterpret_cast<const void*>(attribute.offset)); // NOLINT: OpenGL takes it as a pointer
}
}

void TraceDrawer::upload(const std::vector<TraceVertex>& vertices)
{
  this->Count = static_cast<int>(vertices.size());
  this->Translucent = std::any_of(vertices.begin(), vertices.end(),
    [](const TraceVertex& vertex) { return vertex.color[3] < 255; });
  if (!this->Vertices)
  {
    this->Vertices = vtkSmartPointer<vtkOpenGLBufferObject>::New();
  }
  if (this->Count > 0)
  {
    this->Vertices->Upload(sortedBySpace(vertices), vtkOpenGLBufferObject::ArrayBuffer);
  }
}

void TraceDrawer::setUniforms(Program& program, const TraceScene& scene)
{
  const glm::dvec3 up(glm::row(scene.clipFromWorld, 1));
  program.set("ahead", glm::vec3(scene.ahead));
  program.set("worldFromPoint", glm::mat4(scene.worldFromPoint));
  program.set("clipFromWorld", glm::mat4(scene.clipFromWorld));
  program.set("radius", static_cast<float>(scene.radius));
  program.set("leastRadius", static_cast<float>(scene.leastRadius));
  program.set("pixelsForMm", static_cast<float>(0.5 * scene.size.y * glm::length(up)));
  program.set("hiddenOpacity", static_cast<float>(scene.hiddenOpacity));
  program.set("size", glm::vec2(scene.size));
  std::array<glm::vec2, MaxTissues> hitsFromFraction;
  std::array<glm::vec2, MaxTissues> hitsOfFractionZero;
  std::array<glm::vec3, MaxTissues> nearAhead;
  std::array<glm::vec3, MaxTissues> farAhead;
  for (std::size_t i = 0; i < scene.hits.size(); ++i)
  {
    const FirstHits& hits = *scene.hits[i];
    program.set(("hits" + std::to_string(i)).c_str(), hits.texture.Get());
    hitsFromFraction[i] = glm::vec2(hits.area.textureFromFraction());
    hitsOfFractionZero[i] = glm::vec2(hits.area.textureOfFractionZero());
    nearAhead[i] = glm::vec3(scene.ahead * hits.frustum.near.columns());
    farAhead[i] = glm::vec3(scene.ahead * hits.frustum.far.columns());
  }
  program.set("hitsFromFraction", hitsFromFraction.data(), scene.hits.size());
  program.set("hitsOfFractionZero", hitsOfFractionZero.data(), scene.hits.size());
  program.set("nearAhead", nearAhead.data(), scene.hits.size());
  program.set("farAhead", farAhead.data(), scene.hits.size());
}

void TraceDrawer::drawBalls(unsigned int program)
{
  const PointSizeScope pointSize;
  GLuint vertexArray = 0;
  glGenVertexArrays(1, &vertexArray);
  glBindVertexArray(vertexArray);
  this->Vertices->Bind();
  enable({ "position", 3, GL_FLOAT, offsetof(TraceVertex, position) }, program);
  enable({ "color", 4, GL_UNSIGNED_BYTE, offsetof(TraceVertex, color) }, program);
  glDrawArrays(GL_POINTS, 0, this->Count);
  this->Vertices->Release();
  glBindVertexArray(0);
  glDeleteVertexArrays(1, &vertexArray);
}

bool TraceDrawer::draw(vtkOpenGLRenderWindow* window, const TraceScene& scene, Counters& counters)
{
  const int tissues = static_cast<int>(scene.hits.size());
  Program& program = this->Programs[tissues];
  if (this->Count == 0)
  {
    return true;
  }
  if (!program.use(window, tracesSource(tissues), counters))
  {
    return false;
  }
  const bool fades = tissues > 0 && scene.hiddenOpacity > 0.0 && scene.hiddenOpacity < 1.0;
  const bool apart = fades || this->Translucent;
  this->setUniforms(program, scene);
  program.set("origin", apart ? glm::vec2(0.0f) : glm::vec2(scene.origin));
  vtkOpenGLState* state = window->GetState();
  const SceneScope scope(state, apart);
  state->vtkglViewport(scene.origin.x, scene.origin.y, scene.size.x, scene.size.y);
  state->vtkglScissor(scene.origin.x, scene.origin.y, scene.size.x, scene.size.y);
  state->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  const auto drawBalls = [&] { this->drawBalls(program.get()->GetHandle()); };
  bool drawn = true;
  if (apart)
  {
    this->Image.draw(window, scene.size, drawBalls);
    drawn = this->Image.layOver(window, counters);
  }
  else
  {
    drawBalls();
  }
  for (const FirstHits* hits : scene.hits)
  {
    hits->texture->Deactivate();
  }
  return drawn;
}

void TraceDrawer::releaseGraphicsResources(vtkWindow* window)
{
  this->Image.releaseGraphicsResources(window);
  if (this->Vertices)
  {
    this->Vertices->ReleaseGraphicsResources();
  }
  this->Vertices = nullptr;
  this->Programs.clear();
}
}

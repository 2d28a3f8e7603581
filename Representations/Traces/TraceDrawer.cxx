// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Traces/TraceDrawer.h"

#include "Representations/Gpu/OpenGL.h"
#include "Representations/Gpu/SceneScope.h"
#include "Representations/Traces/TraceOrder.h"

#include "vtkOpenGLBufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

namespace brainshift
{
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
  std::array<glm::vec2, MaxTissues> hitsFromShare;
  std::array<glm::vec2, MaxTissues> hitsOfShareZero;
  std::array<glm::vec3, MaxTissues> nearAhead;
  std::array<glm::vec3, MaxTissues> farAhead;
  for (std::size_t i = 0; i < scene.hits.size(); ++i)
  {
    const FirstHits& hits = *scene.hits[i];
    program.set(("hits" + std::to_string(i)).c_str(), hits.texture.Get());
    hitsFromShare[i] = glm::vec2(hits.area.textureFromShare());
    hitsOfShareZero[i] = glm::vec2(hits.area.textureOfShareZero());
    nearAhead[i] = glm::vec3(scene.ahead * hits.frustum.near.columns());
    farAhead[i] = glm::vec3(scene.ahead * hits.frustum.far.columns());
  }
  program.set("hitsFromShare", hitsFromShare.data(), scene.hits.size());
  program.set("hitsOfShareZero", hitsOfShareZero.data(), scene.hits.size());
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

// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Gpu/Program.h"

#include "Representations/Gpu/OpenGL.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <glm/gtc/type_ptr.hpp>

#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <map>

namespace brainshift
{
// Finds uniforms that a program draws with although they were never set. It is for tests: it works
// while the environment variable BRAINSHIFT_UNIFORM_LOG names a file, and does nothing otherwise.

struct ShaderSource;

/// A program that was made current to draw with.
struct WatchedProgram
{
  const void* window = nullptr; ///< whose OpenGL context the program belongs to
  unsigned int handle = 0;

  bool operator<(const WatchedProgram& other) const
  {
    return this->window != other.window ? this->window < other.window : this->handle < other.handle;
  }
};

/// Gives each active uniform of a program that was just made a value that no code sets.
void markUniforms(const WatchedProgram& program, const ShaderSource& source);

/// Looks at the program that was used before this one, which has drawn by now. The first time it
/// writes a line into the log: the program's name among allSources(), and the names of the uniforms
/// that still have the value of markUniforms().
void checkUniforms(const WatchedProgram& now);

namespace
{
const char* const LogFile = std::getenv("BRAINSHIFT_UNIFORM_LOG");

constexpr int MarkInteger = std::numeric_limits<int>::min();

// Programs that were made and have not been looked at since, with their names.
std::map<WatchedProgram, std::string> Marked;

WatchedProgram Last; // that was used

struct Uniform
{
  std::string name; // of an array: its first element
  GLint location;
  GLenum type;
};

std::vector<Uniform> activeUniforms(GLuint program)
{
  GLint count = 0;
  glGetProgramiv(program, GL_ACTIVE_UNIFORMS, &count);
  std::vector<Uniform> uniforms;
  for (GLint i = 0; i < count; ++i)
  {
    std::array<char, 256> name{};
    GLint size = 0;
    GLenum type = 0;
    glGetActiveUniform(
      program, i, static_cast<GLsizei>(name.size()), nullptr, &size, &type, name.data());
    uniforms.push_back({ name.data(), glGetUniformLocation(program, name.data()), type });
  }
  return uniforms;
}

bool isFloat(GLenum type)
{
  return type == GL_FLOAT || type == GL_FLOAT_VEC2 || type == GL_FLOAT_VEC3 ||
    type == GL_FLOAT_VEC4 || type == GL_FLOAT_MAT3 || type == GL_FLOAT_MAT4;
}

bool isInteger(GLenum type)
{
  return type == GL_INT || type == GL_INT_VEC2 || type == GL_INT_VEC3;
}

// A sampler can hold only the number of a texture unit. The last one is never used.
GLint markSampler()
{
  GLint units = 0;
  glGetIntegerv(GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS, &units);
  return units - 1;
}

void mark(const Uniform& uniform)
{
  std::array<float, 16> nan{};
  nan.fill(std::numeric_limits<float>::quiet_NaN());
  switch (uniform.type)
  {
    case GL_FLOAT:
      return glUniform1fv(uniform.location, 1, nan.data());
    case GL_FLOAT_VEC2:
      return glUniform2fv(uniform.location, 1, nan.data());
    case GL_FLOAT_VEC3:
      return glUniform3fv(uniform.location, 1, nan.data());
    case GL_FLOAT_VEC4:
      return glUniform4fv(uniform.location, 1, nan.data());
    case GL_FLOAT_MAT3:
      return glUniformMatrix3fv(uniform.location, 1, GL_FALSE, nan.data());
    case GL_FLOAT_MAT4:
      return glUniformMatrix4fv(uniform.location, 1, GL_FALSE, nan.data());
    case GL_INT_VEC3:
      return glUniform3i(uniform.location, MarkInteger, MarkInteger, MarkInteger);
    case GL_INT_VEC2:
      return glUniform2i(uniform.location, MarkInteger, MarkInteger);
    default:
      return glUniform1i(uniform.location, isInteger(uniform.type) ? MarkInteger : markSampler());
  }
}

bool isMarked(GLuint program, const Uniform& uniform)
{
  if (isFloat(uniform.type))
  {
    std::array<float, 16> values{};
    glGetUniformfv(program, uniform.location, values.data());
    return std::isnan(values[0]);
  }
  std::array<GLint, 4> values{};
  glGetUniformiv(program, uniform.location, values.data());
  return values[0] == (isInteger(uniform.type) ? MarkInteger : markSampler());
}

std::vector<std::pair<std::string, ShaderSource>> listSources()
{
  std::ofstream log(LogFile);
  log << "listed";
  auto sources = allSources();
  for (const auto& source : sources)
  {
    log << " " << source.first;
  }
  log << "\n";
  return sources;
}

// The name of a program among allSources(), which the first line of the log lists.
std::string nameOfSource(const ShaderSource& source)
{
  static const auto sources = listSources();
  for (const auto& [name, other] : sources)
  {
    if (source.vertex == other.vertex && source.geometry == other.geometry &&
      source.fragment == other.fragment)
    {
      return name;
    }
  }
  return "unlisted";
}
}

void markUniforms(const WatchedProgram& program, const ShaderSource& source)
{
  if (!LogFile)
  {
    return;
  }
  for (const Uniform& uniform : activeUniforms(program.handle))
  {
    mark(uniform);
  }
  Marked[program] = nameOfSource(source);
}

void checkUniforms(const WatchedProgram& now)
{
  if (!LogFile)
  {
    return;
  }
  const WatchedProgram drawn = std::exchange(Last, now);
  const auto marked = Marked.find(drawn);
  if (marked == Marked.end() || drawn.window != now.window)
  {
    return;
  }
  std::ofstream log(LogFile, std::ios::app);
  log << marked->second;
  for (const Uniform& uniform : activeUniforms(drawn.handle))
  {
    log << (isMarked(drawn.handle, uniform) ? " " + uniform.name : "");
  }
  log << "\n";
  Marked.erase(marked);
}

bool Program::use(vtkOpenGLRenderWindow* window, const ShaderSource& source, Counters& counters)
{
  vtkOpenGLShaderCache* cache = window->GetShaderCache();
  if (this->Compiled)
  {
    checkUniforms({ window, static_cast<unsigned int>(this->Compiled->GetHandle()) });
    return cache->ReadyShaderProgram(this->Compiled) != nullptr;
  }
  this->Compiled = cache->ReadyShaderProgram(
    source.vertex.c_str(), source.fragment.c_str(), source.geometry.c_str());
  counters.programsCompiled += 1;
  if (this->Compiled)
  {
    const auto handle = static_cast<unsigned int>(this->Compiled->GetHandle());
    checkUniforms({ window, handle });
    markUniforms({ window, handle }, source);
  }
  return this->Compiled != nullptr;
}

void Program::set(const char* name, int value)
{
  this->Compiled->SetUniformi(name, value);
}

void Program::set(const char* name, float value)
{
  this->Compiled->SetUniformf(name, value);
}

void Program::set(const char* name, const glm::vec2& value)
{
  this->Compiled->SetUniform2f(name, glm::value_ptr(value));
}

void Program::set(const char* name, const glm::vec3& value)
{
  this->Compiled->SetUniform3f(name, glm::value_ptr(value));
}

void Program::set(const char* name, const glm::ivec3& value)
{
  // vtkShaderProgram has no setter for three integers.
  const GLint location = glGetUniformLocation(this->Compiled->GetHandle(), name);
  glUniform3i(location, value.x, value.y, value.z);
}

void Program::set(const char* name, const glm::mat3& value)
{
  glm::mat3 columns = value;
  this->Compiled->SetUniformMatrix3x3(name, glm::value_ptr(columns));
}

void Program::set(const char* name, const glm::mat4& value)
{
  glm::mat4 columns = value;
  this->Compiled->SetUniformMatrix4x4(name, glm::value_ptr(columns));
}

void Program::set(const char* name, const glm::vec2* values, std::size_t count)
{
  const GLint location = glGetUniformLocation(this->Compiled->GetHandle(), name);
  glUniform2fv(location, static_cast<GLsizei>(count), glm::value_ptr(*values));
}

void Program::set(const char* name, const glm::vec3* values, std::size_t count)
{
  const GLint location = glGetUniformLocation(this->Compiled->GetHandle(), name);
  glUniform3fv(location, static_cast<GLsizei>(count), glm::value_ptr(*values));
}

void Program::set(const char* name, vtkTextureObject* texture)
{
  texture->Activate();
  this->Compiled->SetUniformi(name, texture->GetTextureUnit());
}

namespace
{
void drawWithoutBuffers(GLenum mode, int vertices, int instances)
{
  GLuint vertexArray = 0; // the core profile wants one bound, if empty
  glGenVertexArrays(1, &vertexArray);
  glBindVertexArray(vertexArray);
  glDrawArraysInstanced(mode, 0, vertices, instances);
  glBindVertexArray(0);
  glDeleteVertexArrays(1, &vertexArray);
}
}

void drawTriangles(int instances)
{
  drawWithoutBuffers(GL_TRIANGLES, 3, instances);
}

void drawStrip(int vertices)
{
  drawWithoutBuffers(GL_TRIANGLE_STRIP, vertices, 1);
}

FramebufferScope::FramebufferScope(vtkOpenGLState* state)
  : State(state)
{
  state->PushFramebufferBindings();
  glGenFramebuffers(1, &this->Framebuffer);
  state->vtkglBindFramebuffer(GL_FRAMEBUFFER, this->Framebuffer);
}

FramebufferScope::~FramebufferScope()
{
  this->State->PopFramebufferBindings();
  glDeleteFramebuffers(1, &this->Framebuffer);
}

void FramebufferScope::drawColors(unsigned int count)
{
  GLenum attachments[4] = { GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1, GL_COLOR_ATTACHMENT2,
    GL_COLOR_ATTACHMENT3 };
  this->State->vtkglDrawBuffers(count, attachments);
}
}

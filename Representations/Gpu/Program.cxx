// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Gpu/Program.h"

#include "Representations/Gpu/OpenGL.h"
#include "Representations/Gpu/UniformCheck.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include <glm/gtc/type_ptr.hpp>

namespace brainshift
{
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

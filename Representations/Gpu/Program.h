// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// One compiled shader program of a window, and what it takes to run it.
#ifndef BrainShift_Program_h
#define BrainShift_Program_h

#include "Representations/Gpu/GpuTask.h"
#include "Representations/Gpu/ShaderSource.h"

#include <glm/glm.hpp>

#include <cstddef>

class vtkOpenGLRenderWindow;
class vtkOpenGLState;
class vtkShaderProgram;
class vtkTextureObject;

namespace brainshift
{
/// A program. It belongs to the OpenGL context that it was used in first.
class VTKBRAINSHIFTREPRESENTATIONS_EXPORT Program
{
public:
  /// Makes the program current, compiling it the first time. False if it does not compile; VTK's
  /// error output then shows the log.
  bool use(vtkOpenGLRenderWindow* window, const ShaderSource& source, Counters& counters);

  ///@{
  /// Sets a uniform of the program, which must be current.
  void set(const char* name, int value);
  void set(const char* name, float value);
  void set(const char* name, const glm::vec2& value);
  void set(const char* name, const glm::vec3& value);
  void set(const char* name, const glm::ivec3& value);
  void set(const char* name, const glm::mat3& value);
  void set(const char* name, const glm::mat4& value);
  ///@}

  ///@{
  /// Sets an array of `count` vectors.
  void set(const char* name, const glm::vec2* values, std::size_t count);
  void set(const char* name, const glm::vec3* values, std::size_t count);
  ///@}

  /// Binds the texture to a unit of its own, until it is deactivated.
  void set(const char* name, vtkTextureObject* texture);

  vtkShaderProgram* get() const { return this->Compiled; }

  /// The window's resources are gone.
  void forget() { this->Compiled = nullptr; }

private:
  vtkShaderProgram* Compiled = nullptr; // owned by the window's shader cache
};

/// Runs three vertices `instances` times, without buffers.
void drawTriangles(int instances);

/// Runs the vertices of a strip of triangles, without buffers.
void drawStrip(int vertices);

/// A framebuffer of our own. It is bound for drawing until the end of the scope, which binds the
/// earlier ones again. Attach a texture, then call drawColors.
class FramebufferScope
{
public:
  explicit FramebufferScope(vtkOpenGLState* state);
  ~FramebufferScope();
  FramebufferScope(const FramebufferScope&) = delete;
  void operator=(const FramebufferScope&) = delete;

  /// Lets drawing go into the first `count` colour attachments.
  void drawColors(unsigned int count);

private:
  vtkOpenGLState* State;
  unsigned int Framebuffer = 0;
};
}

#endif

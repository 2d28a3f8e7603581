// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Gpu/UniformCheck.h"

#include "Representations/Gpu/OpenGL.h"
#include "Representations/Gpu/ShaderSource.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace brainshift
{
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
  return type == GL_INT || type == GL_INT_VEC3;
}

// A sampler can hold only the number of a texture unit. Nobody uses the last one.
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
}

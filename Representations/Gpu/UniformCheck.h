// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Finds uniforms that a program draws with although nobody set them. It is for tests: it works
/// while the environment variable BRAINSHIFT_UNIFORM_LOG names a file, and does nothing otherwise.
#ifndef BrainShift_UniformCheck_h
#define BrainShift_UniformCheck_h

namespace brainshift
{
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

/// Gives each active uniform of a program that was just made a value that nobody would set.
void markUniforms(const WatchedProgram& program, const ShaderSource& source);

/// Looks at the program that was used before this one, which has drawn by now. The first time it
/// writes a line into the log: the program's name among allSources(), and the names of the uniforms
/// that still have the value of markUniforms().
void checkUniforms(const WatchedProgram& now);
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief What every function needs that works on the GPU: the window, the counters, and a place for
 * what the user has to hear of.
 */
#ifndef BrainShift_GpuTask_h
#define BrainShift_GpuTask_h

#include "Representations/Gpu/Counters.h"

#include <string>
#include <vector>

class vtkOpenGLRenderWindow;

namespace brainshift
{
/// Work on the GPU for one picture.
struct GpuTask
{
  GpuTask(vtkOpenGLRenderWindow* where, Counters& count)
    : window(where)
    , counters(count)
  {
  }

  vtkOpenGLRenderWindow* window;    ///< Its OpenGL context is current.
  Counters& counters;               ///< They count what is done.
  bool moving = false;              ///< Work that the next still picture can do is left to it.
  std::string problem;              ///< One sentence, without a full stop, if the work failed.
  std::vector<std::string> remarks; ///< Sentences for the user, who hears each of them once.

  /// Keeps the sentence as the problem. Returns false, for `return gpu.fail("...")`.
  bool fail(const std::string& sentence)
  {
    this->problem = sentence;
    return false;
  }
};
}

#endif

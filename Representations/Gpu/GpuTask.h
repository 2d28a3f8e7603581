// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The context of every function that works on the GPU: the window, the counters, and the warnings
/// for the user.
#ifndef BrainShift_GpuTask_h
#define BrainShift_GpuTask_h

#include <cstdint>
#include <string>
#include <vector>

class vtkOpenGLRenderWindow;

namespace brainshift
{
// Counts the work of the renderer since it was made. Tests prove with it that a change repeats only
// the work that depends on it.

/// Numbers of one mapper, over all its windows.
struct Counters
{
  std::int64_t frames = 0;          ///< Images that were ray cast.
  std::int64_t pixelsCast = 0;      ///< Pixels of all these images.
  std::int64_t volumeUploads = 0;   ///< Times that scalars were sent to the GPU.
  std::int64_t latticeUploads = 0;  ///< Times that control points were sent to the GPU.
  std::int64_t transferUploads = 0; ///< Times that colour and opacity maps were sent to the GPU.
  std::int64_t segmentUploads = 0; ///< Times that a segment was sent to the GPU, to be drawn alone.
  std::int64_t evidenceUploads = 0;  ///< Times that evidence was sent to the GPU.
  std::int64_t bytesUploaded = 0;    ///< Bytes of all these uploads.
  std::int64_t texelsRefined = 0;    ///< Nodes of the offset field that were computed.
  std::int64_t presenceUpdates = 0;  ///< Times that the deformed presence map was computed.
  std::int64_t skippingBytes = 0;    ///< Faces and leaps sent back; not part of bytesUploaded.
  std::int64_t correctionBytes = 0;  ///< Corrections of the offset field; not in bytesUploaded.
  std::int64_t samplesTaken = 0;     ///< Samples of cast pixels, while CountSamples is on.
  std::int64_t samplesSkipped = 0;   ///< Samples skipped before the ends of these rays.
  std::int64_t imageScale = 1;       ///< Screen pixels a side for one pixel of the last image.
  std::int64_t programsCompiled = 0; ///< Shader programs that were compiled and linked.

  std::int64_t gpuScalarBytes = 0;       ///< Now: textures of the volume's scalars.
  std::int64_t gpuOtherBytes = 0;        ///< Now: all other textures and buffers.
  std::int64_t gpuVoxelsPerTexel = 1;    ///< Now: more than 1 where memory is short.
  std::int64_t gpuNeedsPyramid = 0;      ///< Now: 1 if a file with levels would bring all voxels.
  std::int64_t gpuLevel = -1;            ///< Now: a finer level that bricks are drawn of; -1: none.
  std::int64_t gpuBricks = 0;            ///< Now: bricks of it that are there.
  std::int64_t gpuBricksWanted = 0;      ///< Now: 0 where the view has all that it gets.
  std::int64_t gpuBricksComing = 0;      ///< Now: views that had better be drawn a little later.
  std::int64_t gpuBricksRead = 0;        ///< Now: bricks that the next picture can show.
  std::int64_t gpuBricksLackRoom = 0;    ///< Now: views with more bricks than there is room for.
  std::int64_t gpuFieldMicroseconds = 0; ///< The GPU's last run from lattice to offset field.
};

/// Work on the GPU for one picture.
struct GpuTask
{
  GpuTask(vtkOpenGLRenderWindow* where, Counters& count)
    : window(where)
    , counters(count)
  {
  }

  vtkOpenGLRenderWindow* window;     ///< Its OpenGL context is current.
  Counters& counters;                ///< They count what is done.
  bool moving = false;               ///< Work that the next still picture can do is left to it.
  std::string problem;               ///< One sentence, without a full stop, if the work failed.
  std::vector<std::string> remarks;  ///< Warnings for the user; each is shown once.
  std::vector<std::string> warnings; ///< Warnings that are shown each time.

  bool lacksMemory = false; ///< The work failed for want of memory: less of it may succeed.
  bool refused = false;     ///< The driver was asked for that memory.

  /// Keeps the sentence as the problem. Returns false, for `return gpu.fail("...")`.
  bool fail(const std::string& sentence)
  {
    this->problem = sentence;
    return false;
  }

  /// A part of the picture that failed is left out, as a remark says.
  void goOnWithout(const std::string& what)
  {
    this->remarks.push_back(this->problem + ". " + what);
    this->problem.clear();
    this->lacksMemory = this->refused = false;
  }

  /// The same as fail, if the driver gave no memory.
  bool refuse(const std::string& sentence)
  {
    this->lacksMemory = this->refused = true;
    return this->fail(sentence);
  }
};
}

#endif

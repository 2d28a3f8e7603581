// SPDX-License-Identifier: BSD-3-Clause
// How much memory of the GPU a deformed volume needs, and whether it is there.
#ifndef BrainShift_GpuMemory_h
#define BrainShift_GpuMemory_h

#include "vtkBrainShiftRepresentationsModule.h" // for the export macro

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <string>

class vtkOpenGLRenderWindow;

namespace brainshift
{
// Bytes.
struct MemoryNeed
{
  std::int64_t scalars = 0;
  std::int64_t gradients = 0;
  std::int64_t colors = 0; // of volumes that bring their own, or a second scalar
  std::int64_t segment = 0;
  std::int64_t field = 0; // refined lattice and offset field
  std::int64_t images = 0;
  std::int64_t reference = 0; // of a volume to compare with: scalars, gradients, cavity

  std::int64_t total() const
  {
    return this->scalars + this->gradients + this->colors + this->segment + this->field +
      this->images + this->reference;
  }
};

// What is drawn, as far as memory goes.
struct DrawnSizes
{
  glm::ivec3 voxels{ 0 }; // values a side
  int scalarBytes = 0;    // of one voxel
  int colorBytes = 0;
  bool gradients = false;        // kept in a texture
  bool halfResolution = false;   // of the gradients
  glm::ivec3 forwardNodes{ 0 };  // of the refined lattice, a side; 0: no lattice
  glm::ivec3 backwardNodes{ 0 }; // of the offset field
  int segmentBytes = 0;          // of one voxel; 0: no segment is drawn alone
  bool masked = false;           // a weight for each forward node
  glm::ivec2 pixels{ 0 };
};

VTKBRAINSHIFTREPRESENTATIONS_EXPORT MemoryNeed memoryNeed(const DrawnSizes& sizes);

constexpr double UnknownMemory = -1.0;

// MiB that can still be allocated, as the driver says (GL_NVX_gpu_memory_info or GL_ATI_meminfo);
// UnknownMemory where it does not say.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT double freeMemoryMiB(vtkOpenGLRenderWindow* window);

// Whether the current context is one of Mesa's drivers for processors, which draw in the machine's
// own memory.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT bool drawsInSoftware();

// Takes back what OpenGL has reported so far. True if it was out of memory.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT bool takeOutOfMemory();

// "40.5 MiB (scalars 4, gradients 16, ...)"
VTKBRAINSHIFTREPRESENTATIONS_EXPORT std::string describeNeed(const MemoryNeed& need);

// Empty if `need` fits. `held`: bytes that are allocated already, which `freeMiB` leaves out.
// `limitMiB`: most MiB that may be used in all, 0: no limit. `freeMiB`: or UnknownMemory.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT std::string memoryProblem(
  const MemoryNeed& need, std::int64_t held, double limitMiB, double freeMiB);

// Whether there is memory for what is drawn, as far as one can tell.
class VTKBRAINSHIFTREPRESENTATIONS_EXPORT GpuMemory
{
public:
  // Empty, or one sentence if `need` bytes are not there. `limitMiB` as in memoryProblem.
  std::string ask(vtkOpenGLRenderWindow* window, const MemoryNeed& need, double limitMiB);

  // The GPU ran out although what was asked for last seemed to be there: not asked for again.
  void refuse() { this->Refused = this->Granted; }

  void release() { this->Granted = this->Refused = 0; } // all textures are gone

private:
  std::int64_t Granted = 0; // bytes
  std::int64_t Refused = 0; // bytes at which the GPU ran out; 0: never
};
}

#endif

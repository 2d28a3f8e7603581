// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How much memory of the GPU a deformed volume needs, and whether it is there.
#ifndef BrainShift_GpuMemory_h
#define BrainShift_GpuMemory_h

#include "vtkBrainShiftRepresentationsModule.h" // for the export macro

#include <glm/glm.hpp>

#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

class vtkOpenGLRenderWindow;
class vtkTextureObject;

namespace brainshift
{
// The bytes that textures take on the GPU, as the driver reports them.

/// Bytes of a texture's first level, from the number of bits that the driver chose for each
/// channel. 0 for null. The texture's OpenGL context must be current.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT std::int64_t textureBytes(vtkTextureObject* texture);

/// Bytes of all textures in some groups; null counts 0.
std::int64_t textureBytes(std::initializer_list<std::vector<vtkTextureObject*>> groups);

/// What a deformed volume takes of the GPU, bytes.
struct MemoryNeed
{
  std::int64_t scalars = 0;
  std::int64_t gradients = 0;
  std::int64_t colors =
    0; ///< Of a volume with its own colours, or with a second scalar for colour.
  std::int64_t segment = 0;
  std::int64_t field = 0;       ///< Refined lattice and offset field.
  std::int64_t corrections = 0; ///< Of the offset field; at least, before they are known.
  std::int64_t images = 0;
  std::int64_t reference = 0; ///< Scalars, gradients and cavity of a volume to compare with.

  std::int64_t total() const
  {
    return this->scalars + this->gradients + this->colors + this->segment + this->field +
      this->corrections + this->images + this->reference;
  }
};

/// What memory depends on.
struct DrawnSizes
{
  glm::ivec3 voxels{ 0 };        ///< Values a side.
  int scalarBytes = 0;           ///< Of one voxel.
  int colorBytes = 0;            ///< Of one voxel.
  bool gradients = false;        ///< They are kept in a texture.
  bool halfResolution = false;   ///< Of the gradients.
  glm::ivec3 forwardNodes{ 0 };  ///< Of the refined lattice, a side; 0: no lattice.
  glm::ivec3 backwardNodes{ 0 }; ///< Of the offset field, a side.
  bool corrected = false;        ///< The offset field is to be exact between its nodes, too.
  int segmentBytes = 0;          ///< Of one voxel; 0: no segment is drawn alone.
  bool masked = false;           ///< There is a weight for each forward node.
  glm::ivec2 pixels{ 0 };        ///< Of the picture, a side.
};

/// The memory for what is drawn.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT MemoryNeed memoryNeed(const DrawnSizes& sizes);

constexpr double UnknownMemory = -1.0; ///< The driver does not report its free memory.

/// MiB that can still be allocated, as the driver reports (GL_NVX_gpu_memory_info or
/// GL_ATI_meminfo); UnknownMemory if it does not report any.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT double freeMemoryMiB(vtkOpenGLRenderWindow* window);

/// Whether the current context is one of Mesa's drivers for processors, which draw in the machine's
/// own memory.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT bool drawsInSoftware();

/// Empty, or one sentence if the GPU says that it takes no 3D texture of so many texels a side.
std::string textureProblem(vtkOpenGLRenderWindow* window, const glm::ivec3& texels);

/// The sentence if it said so only when the texture was made.
std::string refusedTexture(const glm::ivec3& texels);

/// Clears the errors that OpenGL has reported so far. True if it was out of memory.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT bool takeOutOfMemory();

/// For example "40.5 MiB (scalars 4, gradients 16, ...)".
VTKBRAINSHIFTREPRESENTATIONS_EXPORT std::string describeNeed(const MemoryNeed& need);

/// Empty if `need` fits, else one sentence. `held`: bytes that are allocated already and do not
/// count as free. `limitMiB`: the most MiB that may be used in all; 0: no limit. `freeMiB`: free
/// MiB, or UnknownMemory.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT std::string memoryProblem(
  const MemoryNeed& need, std::int64_t held, double limitMiB, double freeMiB);

/// Remembers for one window how much memory was there, as far as one can know.
class VTKBRAINSHIFTREPRESENTATIONS_EXPORT GpuMemory
{
public:
  /// Empty, or one sentence if `need` bytes are not there. `limitMiB`: see memoryProblem.
  std::string ask(vtkOpenGLRenderWindow* window, const MemoryNeed& need, double limitMiB);

  /// The GPU ran out of memory although the last need seemed to fit. So much is not granted again.
  void refuse() { this->Refused = this->Granted; }

  /// All textures are gone.
  void release() { this->Granted = this->Refused = 0; }

private:
  std::int64_t Granted = 0; // bytes
  std::int64_t Refused = 0; // bytes at which the GPU ran out; 0: never
};
}

#endif

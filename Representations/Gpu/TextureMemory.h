// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief The bytes that textures take on the GPU, as the driver reports them.
 */
#ifndef BrainShift_TextureMemory_h
#define BrainShift_TextureMemory_h

#include "vtkBrainShiftRepresentationsModule.h" // for the export macro

#include <cstdint>
#include <initializer_list>
#include <vector>

class vtkTextureObject;

namespace brainshift
{
/// Bytes of a texture's first level, from the number of bits that the driver chose for each
/// channel. 0 for null. The texture's OpenGL context must be current.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT std::int64_t textureBytes(vtkTextureObject* texture);

/// Bytes of all textures in some groups; null counts 0.
std::int64_t textureBytes(std::initializer_list<std::vector<vtkTextureObject*>> groups);
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
// What a texture takes on the GPU, as the driver tells.
#ifndef BrainShift_TextureMemory_h
#define BrainShift_TextureMemory_h

#include "vtkBrainShiftRepresentationsModule.h" // for the export macro

#include <cstdint>
#include <initializer_list>
#include <vector>

class vtkTextureObject;

namespace brainshift
{
// Bytes of a texture's first level, from the number of bits the driver chose for each channel; 0
// for null. Its OpenGL context must be current.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT std::int64_t textureBytes(vtkTextureObject* texture);

// The same of many.
std::int64_t textureBytes(std::initializer_list<std::vector<vtkTextureObject*>> groups);
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
// Which part of a picture is kept in textures: where nothing can be seen there is nothing to keep.
#ifndef BrainShift_ImageArea_h
#define BrainShift_ImageArea_h

#include "vtkBrainShiftRepresentationsModule.h" // for the export macro

#include <glm/vec2.hpp>

namespace brainshift
{
// Pixels.
struct ImageArea
{
  glm::ivec2 picture{ 0 }; // size of all of it
  glm::ivec2 low{ 0 };     // first pixel that is kept
  glm::ivec2 size{ 0 };

  glm::ivec2 high() const { return this->low + this->size; } // one past the last
  bool operator==(const ImageArea& other) const
  {
    return this->picture == other.picture && this->low == other.low && this->size == other.size;
  }
  bool operator!=(const ImageArea& other) const { return !(*this == other); }

  // Texture coordinates from the share of the picture: scale and shift.
  glm::dvec2 textureFromShare() const { return glm::dvec2(this->picture) / glm::dvec2(this->size); }
  glm::dvec2 textureOfShareZero() const { return -glm::dvec2(this->low) / glm::dvec2(this->size); }
};

// The area for a picture that can show something from the pixel `low` to before `high`: the one
// held if it will do, so that a camera that moves a little makes nothing anew.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT ImageArea areaAround(
  const ImageArea& held, const glm::ivec2& picture, const glm::ivec2& low, const glm::ivec2& high);
}

#endif

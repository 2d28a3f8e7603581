// SPDX-License-Identifier: BSD-3-Clause
// Which part of a picture is kept in textures: where nothing can be seen there is nothing to keep.
#ifndef BrainShift_ImageArea_h
#define BrainShift_ImageArea_h

#include "vtkBrainShiftRepresentationsModule.h" // for the export macro

#include <glm/vec2.hpp>

#include <vector>

namespace brainshift
{
// Pixels of a picture: the first, and one past the last.
struct PixelBox
{
  glm::ivec2 low{ 0 };
  glm::ivec2 high{ 0 };

  bool empty() const { return this->high.x <= this->low.x || this->high.y <= this->low.y; }
  glm::ivec2 size() const { return this->high - this->low; }
};

// A convex part of a picture: pixels in a box, and in another one that is turned by 45 degrees.
struct PixelPart
{
  PixelBox box;
  PixelBox turned; // of x + y and x - y

  bool empty() const { return this->box.empty() || this->turned.empty(); }
};
// How many they are, about.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT double pixelsIn(const PixelPart& part);
// Its corners, at most eight, in the order of a strip of triangles.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT std::vector<glm::dvec2> stripOf(const PixelPart& part);
// Whether it has so few corners that all of its box is drawn.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT bool isDrawnAsBox(const PixelPart& part);
VTKBRAINSHIFTREPRESENTATIONS_EXPORT PixelPart partOf(const PixelBox& box);
VTKBRAINSHIFTREPRESENTATIONS_EXPORT PixelPart enclosing(const PixelPart& a, const PixelPart& b);

// The least box that holds both.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT PixelBox enclosing(const PixelBox& a, const PixelBox& b);
VTKBRAINSHIFTREPRESENTATIONS_EXPORT PixelBox overlap(const PixelBox& a, const PixelBox& b);
VTKBRAINSHIFTREPRESENTATIONS_EXPORT bool contains(const PixelBox& a, const PixelBox& b);

// Pixels.
struct ImageArea
{
  glm::ivec2 picture{ 0 }; // size of all of it
  glm::ivec2 low{ 0 };     // first pixel that is kept
  glm::ivec2 size{ 0 };

  glm::ivec2 high() const { return this->low + this->size; } // one past the last
  PixelBox box() const { return { this->low, this->high() }; }
  bool operator==(const ImageArea& other) const
  {
    return this->picture == other.picture && this->low == other.low && this->size == other.size;
  }
  bool operator!=(const ImageArea& other) const { return !(*this == other); }

  // Texture coordinates from the share of the picture: scale and shift.
  glm::dvec2 textureFromShare() const { return glm::dvec2(this->picture) / glm::dvec2(this->size); }
  glm::dvec2 textureOfShareZero() const { return -glm::dvec2(this->low) / glm::dvec2(this->size); }
};

// The area for a picture that can show something in a box: the one held if it will do, so that a
// camera that moves a little makes nothing anew.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT ImageArea areaAround(
  const ImageArea& held, const glm::ivec2& picture, const PixelBox& shown);
}

#endif

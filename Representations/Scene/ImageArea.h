// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which part of a picture is kept in textures: only where something can be seen.
#ifndef BrainShift_ImageArea_h
#define BrainShift_ImageArea_h

#include "vtkBrainShiftRepresentationsModule.h" // for the export macro

#include <glm/glm.hpp>

#include <vector>

namespace brainshift
{
/// A box of pixels of a picture: the first one, and one past the last.
struct PixelBox
{
  glm::ivec2 low{ 0 };
  glm::ivec2 high{ 0 };

  bool empty() const { return this->high.x <= this->low.x || this->high.y <= this->low.y; }
  glm::ivec2 size() const { return this->high - this->low; }
};

/// A convex part of a picture: the pixels that lie in a box and in another box, rotated by 45
/// degrees.
struct PixelPart
{
  PixelBox box;
  PixelBox turned; ///< Of x + y and x - y.

  bool empty() const { return this->box.empty() || this->turned.empty(); }
};

/// About how many pixels a part has.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT double pixelsIn(const PixelPart& part);

/// The corners of a part, at most eight, in the order of a strip of triangles.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT std::vector<glm::dvec2> stripOf(const PixelPart& part);

/// Whether a part has so few corners that all of its box is drawn.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT bool isDrawnAsBox(const PixelPart& part);

/// All of a box.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT PixelPart partOf(const PixelBox& box);

/// The least part that holds both.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT PixelPart enclosing(const PixelPart& a, const PixelPart& b);

/// The least box that holds both.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT PixelBox enclosing(const PixelBox& a, const PixelBox& b);

/// The pixels of both boxes.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT PixelBox overlap(const PixelBox& a, const PixelBox& b);

/// Whether all pixels of b are in a.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT bool contains(const PixelBox& a, const PixelBox& b);

/// What a texture holds of a picture, pixels.
struct ImageArea
{
  glm::ivec2 picture{ 0 }; ///< Size of the whole picture.
  glm::ivec2 low{ 0 };     ///< First pixel that is kept.
  glm::ivec2 size{ 0 };    ///< Pixels that are kept.

  /// One past the last pixel that is kept.
  glm::ivec2 high() const { return this->low + this->size; }
  PixelBox box() const { return { this->low, this->high() }; }
  bool operator==(const ImageArea& other) const
  {
    return this->picture == other.picture && this->low == other.low && this->size == other.size;
  }
  bool operator!=(const ImageArea& other) const { return !(*this == other); }

  ///@{
  /// Texture coordinates from the fraction of the picture: scale and shift.
  glm::dvec2 textureFromFraction() const
  {
    return glm::dvec2(this->picture) / glm::dvec2(this->size);
  }
  glm::dvec2 textureOfFractionZero() const
  {
    return -glm::dvec2(this->low) / glm::dvec2(this->size);
  }
  ///@}
};

/// The area for a picture that can show something only in the box `seen`. It is the area that is
/// held if that will do, so that a camera that moves a little needs no new textures.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT ImageArea areaAround(
  const ImageArea& held, const glm::ivec2& picture, const PixelBox& seen);
}

#endif

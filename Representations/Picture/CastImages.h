// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The images that rays are cast into: the picture, the first hits, and helpers.
#ifndef BrainShift_CastImages_h
#define BrainShift_CastImages_h

#include "Representations/Gpu/Program.h"
#include "Representations/Scene/Frustum.h"

class vtkOpenGLRenderWindow;
class vtkTextureObject;
class vtkWindow;

namespace brainshift
{
class ImageScope;
struct RayCastScene;

/// An image of our own, with four channels or fewer, as `format` says. Null if the GPU refuses.
vtkSmartPointer<vtkTextureObject> makeImage(
  vtkOpenGLRenderWindow* window, const glm::ivec2& size, unsigned int format, int filter);

/// Light that is laid over a picture.
struct PictureShade
{
  vtkTextureObject* occlusion = nullptr; ///< As large as the image. Null: the picture stays.
  double darkness = 0.0; ///< Fraction of the light that the greatest occlusion takes away, 0 to 1.
  int margin = 0;        ///< Pixels at each side of the picture that are not shown.
};

/// The images of one window. They hold only that area of the picture where something can be seen.
class CastImages
{
public:
  /// Makes images for the scene. False if the GPU refuses.
  bool prepare(vtkOpenGLRenderWindow* window, const RayCastScene& scene);

  /// Makes the image that samples are counted in, all zero. False if the GPU refuses.
  bool prepareCount(vtkOpenGLRenderWindow* window);

  /// Makes the image in which rays ask for bricks. False if the GPU refuses.
  bool prepareWishes(vtkOpenGLRenderWindow* window);

  /// Lets the scene be drawn into the images: as a picture of its own, or as a `part` of the one
  /// that is held. `variant`: of the program.
  void attach(
    ImageScope& scope, const RayCastScene& scene, bool part, const RayCastVariant& variant);

  /// Draws the pixels of a part, with a program whose vertex stage is outline.vert.glsl.
  void drawPart(Program& program, const PixelPart& part) const;

  /// Adds the counted samples to the counters.
  void readCount(Counters& counters);

  /// What the rays that were cast since the last call asked for: two numbers for each pixel, see
  /// StreamedBricks::finish. Empty if none did.
  std::vector<glm::vec2> takeWishes();

  /// Whether the images hold a whole picture of the scene's size.
  bool hold(const RayCastScene& scene) const;

  /// Whether the images have room for a box of the picture's pixels.
  bool haveRoom(const PixelBox& box) const { return contains(this->Area.box(), box); }

  /// Makes room for the scene's pixels and keeps the picture that is held. False if the GPU
  /// refuses.
  bool grow(vtkOpenGLRenderWindow* window, const RayCastScene& scene, Counters& counters);

  /// Scale and shift that map a fraction of the scene's rays to a fraction between the near and the
  /// far plane of the held picture, in which hits are kept.
  glm::dvec2 hitFromFraction(const RayCastScene& scene) const;

  /// Replaces a part of the held picture by that part of another one, which may be smaller. False
  /// if the shader does not compile.
  bool enlarge(vtkOpenGLRenderWindow* window, const CastImages& other, const PixelPart& part,
    Counters& counters);

  /// Blends the picture over a rectangle (pixels) of the framebuffer that is bound. False if the
  /// shader does not compile.
  bool composite(vtkOpenGLRenderWindow* window, const PixelBox& rectangle,
    const PictureShade& shade, Counters& counters);

  /// First hit (mm, world; then its distance from the near plane, mm) of the last whole picture.
  /// `place`: 0 at the lower left corner, 1 at the upper right one. False if no surface was hit
  /// there or nothing has been cast yet.
  bool hitAt(vtkOpenGLRenderWindow* window, const glm::dvec2& place, glm::dvec4& hit);

  /// First hits of the last whole picture. Null if nothing has been cast yet.
  const FirstHits* hits() const { return this->castHits(false); }

  /// First hits of the last picture, whole or a tile. Null if nothing has been cast yet.
  const FirstHits* drawnHits() const { return this->castHits(this->DrewTile); }

  /// The tile that was cast has a margin: its first hits are those of the tile from now on. The
  /// camera's matrix is that of the tile.
  void trimTile(int margin, const glm::dmat4& clipFromWorld);

  /// What the images hold of the picture.
  const ImageArea& area() const { return this->Area; }

  /// The pixels of the picture that may show something.
  const PixelBox& filled() const { return this->Filled; }

  /// For each ray, its fraction before and behind the occupied bricks.
  vtkTextureObject* spans() const { return this->Spans; }

  /// All textures; some may be null.
  std::vector<vtkTextureObject*> textures() const
  {
    return { this->Image, this->Hits[false].texture, this->Hits[true].texture, this->Count,
      this->Spans, this->Wishes };
  }

  void releaseGraphicsResources(vtkWindow* window);

private:
  const FirstHits* castHits(bool tile) const
  {
    return this->Hits[tile].texture ? &this->Hits[tile] : nullptr;
  }
  void clearStale(const RayCastScene& scene);
  void clear(unsigned int target);

  bool DrewTile = false;
  ImageArea Area;                          // of Image, Spans, Count and the Hits drawn last
  PixelBox Filled;                         // Image is empty elsewhere
  PixelBox HitsFilled[2];                  // Hits hold none elsewhere; [tile]
  FirstHits Hits[2];                       // [tile]
  vtkSmartPointer<vtkTextureObject> Image; // colour times opacity, opacity
  vtkSmartPointer<vtkTextureObject> Count; // samples taken and skipped; null unless asked for
  vtkSmartPointer<vtkTextureObject> Spans;
  vtkSmartPointer<vtkTextureObject> Wishes; // for bricks; null unless rays ask
  bool HasWishes = false;                   // that nobody has taken
  Program CompositePrograms[2];             // [occluded]
  Program EnlargeProgram;
};
}

#endif

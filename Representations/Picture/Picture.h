// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The picture of a volume that a window keeps.
///
/// Pixels that a stroke leaves as they were are not cast again. Only those are cast behind which
/// tissue moved, so that these can have more of a moving frame's time.
#ifndef BrainShift_Picture_h
#define BrainShift_Picture_h

#include "Representations/Field/FieldTexture.h"
#include "Representations/Picture/MovingQuality.h"
#include "Representations/Picture/Occlusion.h"
#include "Representations/Picture/RayCaster.h"
#include "Representations/Picture/SeenPixels.h"
#include "Representations/Scene/SceneDepth.h"
#include "Representations/Scene/SceneFrame.h"

class vtkTextureObject;
class vtkWindow;

namespace brainshift
{
// Finds what has changed since the last picture. While a tool hovers, only its outline over
// the picture changes. While it bends, only the tissue that it moves changes.

struct Counters;
struct RayCastScene;

/// Remembers what the last picture depended on.
class VTKBRAINSHIFTREPRESENTATIONS_EXPORT PictureStamp
{
public:
  enum Change
  {
    Nothing,  ///< The picture would be the same.
    Bending,  ///< Only the values of the offset field changed.
    Reaching, ///< Besides, the space of tissue grew or shrank: rays begin elsewhere.
    Anything  ///< The whole picture is new.
  };

  /// Compares with the last call and remembers this one. Anything in front of or behind the
  /// volume counts, too, but not the props that are drawn over volumes. `settingsTime`: when the
  /// settings of the mapper changed last.
  Change change(const DrawnVolume& drawn, unsigned long long settingsTime,
    const RayCastScene& scene, const Counters& counters);

  /// The next call finds that anything has changed.
  void forget() { this->Last.clear(); }

private:
  std::vector<double> Last; // all but what bending changes
  std::vector<double> LastBending;
  std::vector<double> LastSpace;
};

/// Remembers what rays of a view can see, whichever bricks of a finer level are there.
class VTKBRAINSHIFTREPRESENTATIONS_EXPORT ViewStamp
{
public:
  enum Change
  {
    Nothing, ///< Rays see the same tissue.
    Others,  ///< What is in front of the volume changed: it may hide less of it.
    View     ///< Camera, size, settings, cuts or deformation changed.
  };

  /// Compares with the last call and remembers this one, as PictureStamp does. The scene's image
  /// has its size.
  Change change(const DrawnVolume& drawn, unsigned long long settingsTime,
    const RayCastScene& scene, const Counters& counters);

private:
  std::vector<double> Last;
  std::vector<double> LastOthers;
};

struct GpuTask;

/// How a picture is wanted.
struct PictureWish
{
  bool adaptive = true;      ///< Fewer pixels and longer steps while the window moves.
  bool keep = false;         ///< Cast nothing that would look the same.
  bool countSamples = false; ///< Counters learn of samples; Composite only.
  double rate = 0.0;         ///< Pictures a second that the window wants.
  OcclusionWish occlusion;   ///< Of still pictures.
  int margin = 0;            ///< Pixels at each side that are cast and not shown.
  glm::ivec2 origin{ 0 };    ///< Of the picture in the window, pixels.
  glm::ivec2 size{ 0 };      ///< Of the picture, pixels.

  unsigned long long settingsTime = 0; ///< When the settings of the mapper changed last.
};

/// Whether the picture may be a rough one, because the next one follows at once.
bool isMovingPicture(const PictureWish& wish);

/// Calls for one picture: begin, bend, cast, end.
class Picture
{
public:
  /// From here on the time of the picture is measured.
  void begin() { this->Pace.beginPicture(); }

  /// The offset field has changed there since the last picture.
  void bend(const FieldTexture::Bent& bent);

  /// The next picture is cast as a whole.
  void forget() { this->Stamp.forget(); }

  /// The next picture casts what the last one cast, too: its rays ask for other bricks.
  void castAgain();

  /// Casts what has changed and fills in the image of the scene. False if a shader does not compile
  /// or an image cannot be made.
  bool cast(GpuTask& gpu, const DrawnVolume& drawn, const PictureWish& wish, RayCastScene& scene);

  /// OpenGL has all commands of the picture.
  void end() { this->Pace.endPicture(); }

  CastImages& images() { return this->Whole.images(); }
  const CastImages& images() const { return this->Whole.images(); }

  /// The bricks that rays asked for since the last call, also where fewer of them were cast.
  std::vector<glm::vec2> takeWishes();

  /// The light to lay over the picture that was cast last.
  const PictureShade& shade() const { return this->Shade; }

  /// All textures; some may be null.
  std::vector<vtkTextureObject*> textures() const;

  void releaseGraphicsResources(vtkWindow* window);

private:
  bool canKeep(PictureStamp::Change change, const PictureWish& wish, const RayCastScene& scene);
  bool castAll(GpuTask& gpu, const PictureWish& wish, RayCastScene& scene);
  bool castChanged(GpuTask& gpu, const PictureWish& wish, RayCastScene& scene);
  bool castRoughly(GpuTask& gpu, const PictureWish& wish, const MovingQuality& quality,
    const RayCastScene& scene, const PixelPart& part);
  bool occlude(GpuTask& gpu, const PictureWish& wish, const RayCastScene& scene);
  PixelPart changedPart(bool moving, const RayCastScene& scene) const;
  bool isBent() const { return this->Bent.all || !this->Bent.corners.empty(); }
  MovingQuality qualityFor(const PictureWish& wish, const PixelPart& part) const;
  template <typename Cast>
  bool measure(
    const GpuTask& gpu, const PictureWish& wish, const RayCastScene& scene, const Cast& cast);

  RayCaster Whole;
  RayCaster Rough;         // parts with fewer pixels, on their way into Whole
  SceneDepth Depth;        // of what is drawn already
  PictureStamp Stamp;      // of what Whole holds
  FieldTexture::Bent Bent; // what changed since
  TextureBox Space;        // the space that tissue could reach in any part of what Whole holds
  bool Mixed = false;      // parts of what Whole holds had rays that began elsewhere
  PixelPart RoughPart;     // of what Whole holds: not at full quality
  PixelPart LastPart;      // that was cast last
  bool LastWasWhole = true;
  PixelPart Again; // is cast once more
  brainshift::Occlusion Occlusion;
  PictureShade Shade;
  bool CastMoving = false; // some of what Whole holds was cast while something moved
  WindowPace Pace;
  double SecondsPerPixel = 0.0; // of the last one cast, with the usual step; 0: none yet
};
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Ambient occlusion: how much the tissue around each first hit of a still picture hides it from
/// light.
///
/// It is found from the first hits alone, which are on the visible surface of bent tissue. So a ray
/// takes no more samples, and the kept colours stay as they are.
///
/// Screen-space ambient occlusion: Mittring, "Finding next gen: CryEngine 2", SIGGRAPH 2007
/// courses. The estimate by pairs of opposite neighbours is our own (occlusion.frag.glsl).
#ifndef BrainShift_Occlusion_h
#define BrainShift_Occlusion_h

#include "Representations/Gpu/Program.h"
#include "Representations/Scene/Frustum.h"

class vtkTextureObject;
class vtkWindow;

namespace brainshift
{
struct GpuTask;
struct RayCastScene;

/// How much darker grooves are.
struct OcclusionWish
{
  double darkness = 0.0; ///< Fraction of the light that the greatest occlusion takes away, 0 to 1.
  double radius = 1.0;   ///< Radius within which tissue hides light, mm, world. Above 0.
};

/// The occlusion of the picture of one window.
class Occlusion
{
public:
  /// Whether the scene's tissue has surfaces that light can miss.
  static bool isFor(const RayCastScene& scene);

  /// The largest fraction of its light that a ray can gain within a length of the scene's tissue, 0
  /// to 1. Occlusion belongs to the tissue at a first hit: if that is translucent, a ray gains most
  /// of its light elsewhere. `radius`: the length, mm, world.
  static double seenWithin(const RayCastScene& scene, double radius);

  /// Pixels around a picture that its occlusion depends on. `clipFromWorld`: the camera's matrix;
  /// `size`: of the picture, pixels; `radius`: mm.
  static int reach(const glm::dmat4& clipFromWorld, const glm::ivec2& size, double radius);

  /// These pixels of the picture are new since the last update.
  void change(const PixelBox& pixels) { this->Stale = enclosing(this->Stale, pixels); }

  /// Finds the occlusion of the pixels that are new and of their neighbours, `radius` mm around.
  /// Another radius needs all pixels to be new. False if a shader does not compile or an image
  /// cannot be made.
  bool update(GpuTask& gpu, const FirstHits& hits, const RayCastScene& scene, double radius);

  /// As large as the images of the hits; 0 to 1. Null before the first update.
  vtkTextureObject* texture() const { return this->Smooth; }

  /// All textures; some may be null.
  std::vector<vtkTextureObject*> textures() const { return { this->Rough, this->Smooth }; }

  void releaseGraphicsResources(vtkWindow* window);

private:
  bool prepare(GpuTask& gpu, const ImageArea& area);
  bool drawRough(GpuTask& gpu, const FirstHits& hits, const RayCastScene& scene, double radius);
  bool drawSmooth(GpuTask& gpu, const FirstHits& hits, double radius);

  PixelBox Stale;                           // these pixels of the picture have other hits
  ImageArea Area;                           // of both textures
  vtkSmartPointer<vtkTextureObject> Rough;  // occlusion, and the first hit
  vtkSmartPointer<vtkTextureObject> Smooth; // occlusion, averaged
  Program RoughProgram;
  Program SmoothProgram;
};
}

#endif

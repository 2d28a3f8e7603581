// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The textures that rays and slices read in the volume at rest: scalars, colours, opacity,
/// gradients, segment.
#ifndef BrainShift_TissueTextures_h
#define BrainShift_TissueTextures_h

#include "Representations/Gpu/GpuMemory.h"
#include "Representations/Scene/VolumeChoices.h"
#include "Representations/Tissue/CategoryScalars.h"
#include "Representations/Tissue/NormalTexture.h"
#include "Representations/Tissue/ScalarTexture.h"
#include "Representations/Tissue/SegmentTexture.h"
#include "Representations/Tissue/SteepnessTexture.h"
#include "Representations/Tissue/TransferTexture.h"

class vtkTextureObject;
class vtkVolumeProperty;
class vtkWindow;

namespace brainshift
{
struct GpuTask;

/// Where the gradients that light needs come from; numbers as in vtkDeformedVolumeMapper.
enum class GradientSource
{
  HalfResolution = 0,
  FullResolution = 1,
  OnTheFly = 2,
};

/// What would bring bricks of finer voxels to a volume that is drawn coarser for want of memory.
enum class FinerBy
{
  Nothing, ///< What is drawn takes no bricks.
  Level,   ///< Its file has levels: a smaller one leaves room for bricks of the others.
  Pyramid, ///< It needs a file with levels.
};

/// A ray through all of a volume takes a limited number of samples, so that a picture ends.
constexpr double MostSamplesOfRay = 8192.0;

/// Which tissue is to be drawn, and how.
struct TissueRequest
{
  vtkVolumeProperty* property = nullptr;
  DrawnValues values;          ///< Without scalars there is no tissue.
  glm::ivec3 wholePoints{ 0 }; ///< Points a side; the values may be of a part.
  double stepMm = 1.0;
  bool usualStep = true; ///< Nobody chose it: it follows the voxels.
  Blend blend = Blend::Composite;
  GradientSource gradients = GradientSource::FullResolution;
  bool nearest = false; ///< Voxels are drawn as they are, not blended.
  bool labels = false;  ///< Values are numbers of something: an average means nothing.
  bool skips = true;    ///< Leap over empty space if the picture stays the same.
  SegmentRequest segment;
  Opacity opacity = Opacity::Scalar;
  glm::dvec2 range{ 0.0, 1.0 }; ///< Values that steepness and 2D transfer functions count by.
  StoredScalar mapped;          ///< Value for colours and opacities: scalar * scale + shift.
  FinerBy finerBy = FinerBy::Nothing;
  bool compared = false; ///< Beside a reference, whose values are no categories.
};

/// The textures of one volume in one window.
class TissueTextures
{
public:
  /// Uploads what changed and fills the scene's tissue. False, with a problem, if this GPU cannot.
  bool update(GpuTask& gpu, const TissueRequest& request, SceneTissue& tissue);

  /// Whether updates since the last call changed which scalars can be seen, or where they are.
  bool takeVisibilityChange() { return std::exchange(this->VisibilityChanged, false); }

  /// Lets the ranges of rest bricks hold others, too: of finer voxels that are drawn there.
  void widenRanges(const glm::ivec3& first, const BrickRanges& others);

  /// Bricks of the rest volume, a side.
  const glm::ivec3& restBricks() const { return this->Scalars.ranges().count; }

  /// The sums of visible rest bricks, see RestPresence.h.
  std::vector<float> summedVisibility() const;

  /// Whether a picture stays the same if samples that cannot be seen are skipped. That is false
  /// where such samples count, as in an average.
  bool skippingIsExact(Blend blend) const;

  vtkTextureObject* scalars() const { return this->Scalars.texture(); }

  /// All other textures. Null: not in use.
  std::vector<vtkTextureObject*> otherTextures() const;

  /// The value for colours and opacities from what the texture of scalars stores.
  const StoredScalar& stored() const { return this->Stored; }

  /// A sentence if the segment that is drawn holds nothing; else empty.
  const std::string& remark() const { return this->Segment.remark(); }

  void releaseGraphicsResources(vtkWindow* window);

private:
  bool updateMapped(GpuTask& gpu, const TissueRequest& request, SceneTissue& tissue);
  TissueRequest withCategories(GpuTask& gpu, const TissueRequest& request);
  void noteVisibility(const TissueRequest& request, bool uploaded);
  bool updateTransfer(GpuTask& gpu, const TissueRequest& request, Coloring coloring);
  bool updateColors(GpuTask& gpu, const TissueRequest& request, SceneColoring& coloring);
  bool updateSegment(GpuTask& gpu, const TissueRequest& request, SceneTissue& tissue);
  bool updateGradients(GpuTask& gpu, const TissueRequest& request, SceneTissue& tissue);
  void describe(const TissueRequest& request, SceneTissue& tissue) const;
  SceneSteepness steepnessFor(const TissueRequest& request) const;

  CategoryScalars Categories;
  ScalarTexture Scalars;
  ScalarTexture ColorScalars; // where another number of the voxel gives the colour
  ColorTexture Colors;        // where the voxel brings its colour along
  TransferTexture Transfer;
  SteepnessTexture Steepness;
  NormalTexture Normals;
  SegmentTexture Segment;
  StoredScalar Stored;
  Blend VisibleBlend = Blend::Composite;
  std::vector<double> VisibleIsovalues; // those that are looked for
  bool VisibilityChanged = false;
};

/// Adds what the tissue takes of the GPU's memory.
void addTissueSizes(const TissueRequest& request, DrawnSizes& sizes);
}

#endif

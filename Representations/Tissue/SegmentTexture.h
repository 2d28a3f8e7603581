// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The segment that is drawn alone: the fraction of the space around each value that belongs to it.
#ifndef BrainShift_SegmentTexture_h
#define BrainShift_SegmentTexture_h

#include "Filters/Attached/Segmentation.h"
#include "Representations/Gpu/GpuTask.h"
#include "Representations/Skipping/RestPresence.h"

#include "vtkTextureObject.h" // for its smart pointer

class vtkImageData;
class vtkOpenGLRenderWindow;
class vtkWindow;

namespace brainshift
{
struct ValueLayout;

/// Which segment of which labels.
struct SegmentRequest
{
  Segmentation segmentation; ///< Without labels all tissue is drawn.
  std::vector<int> chosen;   ///< Labels to draw; none: all above 0.
};

/// The middles of the texels of a volume on `grid`.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT Grid gridOfTexels(const Grid& grid, const ValueLayout& layout);

/// What is drawn of a volume: the labels in `asked`, or else those that its segmentation
/// means. There are no labels, but one sentence in `remark`, if the volume carries no segmentation.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT SegmentRequest requestSegment(
  vtkImageData* volume, const std::vector<int>& asked, std::string& remark);

/// The ranges of those bricks that reach into the segment. The other bricks hold no number.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT BrickRanges rangesWithin(
  const BrickRanges& bricks, const std::vector<char>& reaching);

/// 1 for each brick in which, BrickMargin around it included, interpolation may find more than
/// LeastFraction of the segment. `fractions`: the result of segmentFractions.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT std::vector<char> bricksReaching(
  const std::vector<std::uint8_t>& fractions, const glm::ivec3& dimensions);

/// A texture of fractions, linear in between; null if the GPU refuses.
vtkSmartPointer<vtkTextureObject> fractionTexture(vtkOpenGLRenderWindow* window,
  std::vector<std::uint8_t> fractions, const glm::ivec3& side, Counters& counters);

/// The fractions of one segment on the GPU of one window.
class SegmentTexture
{
public:
  SegmentTexture();
  ~SegmentTexture();

  /// Uploads the segment at `texels` if it changed. Without labels, lets go of the texture.
  /// `changed`: whether it is another segment than before. False if the GPU refuses.
  bool update(GpuTask& gpu, const SegmentRequest& request, const Grid& texels, bool& changed);

  /// Bytes of a voxel on the GPU of the current context.
  static int bytesOfVoxel();

  /// Null: all tissue is drawn.
  vtkTextureObject* texture() const { return this->Texture; }

  /// While there is a texture: the ranges of the volume's bricks within the segment.
  BrickRanges within(const BrickRanges& bricks) const
  {
    return rangesWithin(bricks, this->Reaching);
  }

  /// A sentence if no voxel belongs to the segment; else empty.
  const std::string& remark() const { return this->Remark; }

  void releaseGraphicsResources(vtkWindow* window);

private:
  bool holds(const SegmentRequest& request, const Grid& texels) const;

  vtkSmartPointer<vtkTextureObject> Texture;
  SegmentRequest Uploaded;
  Grid Texels;
  unsigned long long UploadedTime = 0;
  std::vector<char> Reaching;
  std::string Remark;
};
}

#endif

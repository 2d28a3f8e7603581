// SPDX-License-Identifier: BSD-3-Clause
// The segment that is drawn alone, on the GPU: how much of the place around each of the volume's
// values belongs to it.
#ifndef BrainShift_SegmentTexture_h
#define BrainShift_SegmentTexture_h

#include "Representations/Gpu/Counters.h"
#include "Representations/Skipping/RestPresence.h"
#include "Filters/Attached/Segmentation.h"

#include "vtkSmartPointer.h"
#include "vtkTextureObject.h" // for its smart pointer

#include <string>
#include <vector>

class vtkImageData;
class vtkOpenGLRenderWindow;
class vtkWindow;

namespace brainshift
{
struct ValueLayout;

// Which segment of which labels, at which points.
struct SegmentRequest
{
  Segmentation segmentation; // without labels all tissue is drawn
  std::vector<int> chosen;   // labels to draw; none: all above 0
  Grid points;               // of the volume's values
};

// What is drawn of a volume on `grid`: the labels asked for, or else those that its segmentation
// means. No segmentation, with one sentence in `remark`, if the volume carries none.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT SegmentRequest requestSegment(vtkImageData* volume,
  const Grid& grid, const ValueLayout& layout, const std::vector<int>& asked, std::string& remark);

// Bricks, of what brickRanges found, that reach into the segment; others hold no number.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT BrickRanges rangesWithin(
  const BrickRanges& bricks, const std::vector<char>& reaching);

// 1 for each brick in which interpolation may find more than LeastShare, BrickMargin around it
// included. `shares`: of segmentShares.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT std::vector<char> bricksReaching(
  const std::vector<std::uint8_t>& shares, const glm::ivec3& dimensions);

class SegmentTexture
{
public:
  SegmentTexture();
  ~SegmentTexture();

  // Makes it current; without labels, lets go of it. `changed`: whether it is another segment than
  // before. False if the GPU refuses.
  bool update(vtkOpenGLRenderWindow* window, const SegmentRequest& request, Counters& counters,
    bool& changed);

  // That a voxel takes on the GPU of the current context.
  static int bytesOfVoxel();

  // Null: all tissue is drawn.
  vtkTextureObject* texture() const { return this->Texture; }

  // While there is a texture: the ranges that visibility is asked of instead of the volume's.
  BrickRanges within(const BrickRanges& bricks) const
  {
    return rangesWithin(bricks, this->Reaching);
  }

  // A sentence if no voxel belongs to the segment; else empty.
  const std::string& remark() const { return this->Remark; }

  void releaseGraphicsResources(vtkWindow* window);

private:
  bool holds(const SegmentRequest& request) const;

  vtkSmartPointer<vtkTextureObject> Texture;
  SegmentRequest Uploaded;
  unsigned long long UploadedTime = 0;
  std::vector<char> Reaching;
  std::string Remark;
};
}

#endif

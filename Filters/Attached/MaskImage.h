// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Reads a mask or a cavity from an image of labels or scalars, on points or in cells, on any grid.
///
/// A cavity is tissue that was removed. Colours and numbers ignore it.
#ifndef BrainShift_MaskImage_h
#define BrainShift_MaskImage_h

#include "Filters/Attached/ReferenceVolume.h"

#include "vtkImageData.h" // for its smart pointer

#include <string>

class vtkDataArray;

namespace brainshift
{
/** What messages call things. */
struct MaskNames
{
  std::string mask = "mask";         ///< the image
  std::string volume = "volume";     ///< the volume that it is for
  std::string labels = "MaskLabels"; ///< the property that chooses labels
};

/** The numbers of an image that are read as labels, and where they lie. */
struct LabelImage
{
  vtkDataArray* labels = nullptr; ///< null: the image has none; not owned
  Grid grid;                      ///< of the points, or of the middles of the cells
};

/**
 * The labels of an image: the active point scalars if they have one component, else the first point
 * array of one component, else the same of the cells.
 */
LabelImage labelsOf(vtkImageData* image);

/**
 * Throws a Problem if an image cannot be the labels of a volume: it has none, or does not overlap
 * the volume.
 */
void requireLabels(const LabelImage& image, const Grid& volume, const MaskNames& names = {});

/** 1 for each number that is one of the labels, else 0. Without labels, 1 for each above 0. */
std::vector<char> insideOf(vtkDataArray* array, const std::vector<int>& labels);

/** Reads a mask. Throws a Problem if the image cannot be a mask for the volume. */
VTKBRAINSHIFTFILTERS_EXPORT Mask readMask(vtkImageData* image, const std::vector<int>& labels,
  const Grid& volume, const MaskNames& names = {});

/** All that the weights of a mask depend on. */
struct MaskRequest
{
  vtkImageData* image = nullptr; ///< null or empty: no mask
  std::vector<int> labels;       ///< labels that are inside; none: all above 0
  double growMm = 0.0;           ///< mm by which the mask grows first; 0 or more
  double featherMm = 0.0;        ///< mm over which weights rise from 0 to 1; 0 or more
  Grid volume;                   ///< which the mask must overlap
  Grid lattice;                  ///< control points
  int samples = 0;               ///< nodes between two control points, 0 to 16
};

/** Finds weights, and keeps those of the last request until something in it changes. */
class VTKBRAINSHIFTFILTERS_EXPORT MaskSource
{
public:
  /**
   * Finds the weights; null without a mask. Throws a Problem if the image is no mask, or if the
   * machine has too little memory to grow it.
   */
  std::shared_ptr<const NodeWeights> find(const MaskRequest& request);

private:
  bool isKnown(const MaskRequest& request) const;

  MaskRequest Known;
  unsigned long long KnownTime = 0;           // of its image
  std::shared_ptr<const NodeWeights> Weights; // null: the last mask was none
};

/**
 * Reads a cavity, or a tumour, from an image. It keeps the voxels of the last image and hands out
 * the same array object as long as nothing of the image changes.
 */
class VTKBRAINSHIFTFILTERS_EXPORT CavitySource
{
public:
  /**
   * Finds its voxels. Throws a Problem if the image is no mask.
   *
   * @param image        null or empty: no cavity
   * @param labels       labels of the cavity; none: all above 0
   * @param volume       the volume that the cavity must overlap
   * @param names        what messages call the image, that volume and the property of the labels
   * @return the voxels (1 or 0); no voxels without an image
   */
  PlacedVoxels find(vtkImageData* image, const std::vector<int>& labels, const Grid& volume,
    const MaskNames& names);

private:
  vtkSmartPointer<vtkDataArray> Voxels; // null: the last image was no mask
  Grid VoxelsGrid;
  vtkSmartPointer<vtkImageData> Image; // that Voxels shows, as of ImageTime
  unsigned long long ImageTime = 0;
  std::vector<int> Labels;
};

/**
 * Whether the voxel nearest to a position (mm, world) is cavity. False beyond the voxels, and if
 * there is no cavity.
 */
VTKBRAINSHIFTFILTERS_EXPORT bool isRemoved(const PlacedVoxels& cavity, const glm::dvec3& position);
}

#endif

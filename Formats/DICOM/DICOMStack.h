// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Sorts the images of a series into volumes, and tells where their voxels lie.
///
/// Slices are sorted by their positions along the normal of the images; the spacing comes from the
/// positions as well. Images at one position are points in time.
#ifndef BrainShift_DICOMStack_h
#define BrainShift_DICOMStack_h

#include "Formats/DICOM/DICOMImages.h"

namespace brainshift
{
/** Slices that lie farther from even ones are told. Decimals of headers stay below, mm. */
constexpr double LargestUnreportedShiftMm = 0.02;

/** Where an image lies on an upright grid. */
struct DICOMShift
{
  double columns = 0.0; ///< from the first column of the grid to that of the image
  double rows = 0.0;    ///< likewise
};

/** One slice of an upright grid, as a mean of two images. */
struct DICOMSlice
{
  std::size_t lower = 0;    ///< index of an image of the volume; the next one is above
  double lowerWeight = 1.0; ///< of the lower image; the rest is the upper image's
};

/** How images become an upright grid. */
struct DICOMResampling
{
  int columns = 0;                ///< of the grid
  int rows = 0;                   ///< of the grid
  std::vector<DICOMShift> shifts; ///< of each image
  std::vector<DICOMSlice> slices; ///< of the grid; empty: images stay as they are
};

/** Volumes of one series. */
struct DICOMStack
{
  std::vector<std::vector<DICOMFrame>> volumes; ///< of each time; images from below to above
  std::vector<double> times;                    ///< s; at least one
  DICOMResampling resampling;                   ///< of each volume
  glm::dmat4 worldFromVoxel{ 1.0 };             ///< mm, RAS; x along rows, z along slices
  bool knowsSides = true;                       ///< whether images say where they lie
  std::vector<std::string> warnings;            ///< ends of sentences
};

/** Distances of the places along the normal of images, mm, from below to above. */
std::vector<double> placesOf(const std::vector<DICOMFrame>& images);

/**
 * Sorts images.
 *
 * @param files        of the images
 * @param images       of one size and orientation; at least one
 * @param resampling   when uneven or tilted slices are interpolated on an upright grid
 */
DICOMStack stackOf(const std::vector<DICOMFile>& files, const std::vector<DICOMFrame>& images,
  SliceResampling resampling);
}

#endif

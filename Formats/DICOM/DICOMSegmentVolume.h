// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The segments of one DICOM file as volumes on one grid: label maps, or fractions.
///
/// Segments that share a voxel are in different layers, so that none hides another one. Each
/// segment is in the first layer where it shares no voxel. Fractions have a layer for each segment.
#ifndef BrainShift_DICOMSegmentVolume_h
#define BrainShift_DICOMSegmentVolume_h

#include "Formats/DICOM/DICOMSegments.h"

namespace brainshift
{
class SegmentOverlaps;

class DICOMSegmentVolume
{
public:
  /** Finds grid and layers; for that it reads the pixels. Throws the end of a sentence. */
  explicit DICOMSegmentVolume(DICOMFile file, const Progress& progress);

  /** Names of the layers, such as "layer 2 of 3: tumour, vessel". Empty if there is one layer. */
  std::vector<std::string> layerNames() const;

  /** Describes a layer, an index of layerNames, or 0. */
  void describe(std::size_t layer, VolumeHeader& header) const;

  /** Segments that the other layers have, for a warning. */
  std::string namesOutside(std::size_t layer) const;

  /** Reads a layer. Throws the end of a sentence. No image if `progress` says stop. */
  void load(std::size_t layer, const Progress& progress, StoredVoxels& voxels) const;

  /** Bytes of frames that are in memory at once. */
  static constexpr double BytesAtOnce = 1 << 26;

private:
  using Frames = std::vector<std::size_t>; // indices of frames of the file

  // Calls use(frame, its numbers) for frames, some after the other. False if `progress` says stop.
  template <typename Number, typename Use>
  bool visit(const Frames& frames, const Progress& progress, const Use& use) const;
  template <typename Number>
  bool paint(std::size_t layer, const Progress& progress, vtkImageData* image) const;
  void findOverlaps(const Progress& progress, SegmentOverlaps& overlaps) const;
  void findLayers(const Progress& progress);
  std::string namesOf(std::size_t layer, bool outside) const;

  DICOMFile File;
  DICOMSegmentGrid Grid;
  int StoredType = VTK_UNSIGNED_CHAR;   // of the file
  int Type = VTK_UNSIGNED_CHAR;         // of the volume
  std::vector<std::vector<int>> Layers; // numbers of the segments in each
};
}

#endif

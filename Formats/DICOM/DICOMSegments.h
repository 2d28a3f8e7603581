// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What a segmentation of DICOM has of its segments, and the grid of their frames.
///
/// A frame is one segment in one slice. Slices without a segment have no frame: they are empty.
#ifndef BrainShift_DICOMSegments_h
#define BrainShift_DICOMSegments_h

#include "Formats/DICOM/DICOMDataSet.h"
#include "Formats/DICOM/DICOMImages.h"

namespace brainshift
{
/** What a data set is by its class. Throws the end of a sentence if its type is not known. */
SegmentKind segmentKindOf(const DICOMDataSet& set);

/** Reads names, colours and coded terms of the segments, or throws the end of a sentence. */
void readSegments(const DICOMDataSet& set, DICOMSegments& segments);

/** Throws the end of a sentence if a frame is of a segment that is not described. */
void requireSegments(const DICOMFile& file);

///@{
/**
 * Red, green and blue of a colour as DICOM stores it, and back: CIELab (L*, a*, b* in 16 bits each)
 * with the white of D65, as DCMTK, dcmqi, 3D Slicer and OHIF write it.
 */
std::array<unsigned char, 3> rgbOfLab(const std::array<int, 3>& lab);
std::array<int, 3> labOfRgb(const std::array<unsigned char, 3>& rgb);
///@}

/** The positions of the frames of a segmentation. */
struct DICOMSegmentGrid
{
  glm::dmat4 worldFromVoxel{ 1.0 };  ///< mm, RAS; x along rows, z along slices
  int slices = 1;                    ///< also those that no frame has
  std::vector<int> sliceOfFrame;     ///< from below to above, of each frame of the file
  std::vector<std::string> warnings; ///< ends of sentences
};

/**
 * Finds the grid by the positions of the frames. Throws the end of a sentence if they are not on
 * one: if their directions or distances differ, or if a slice has two frames of one segment.
 */
DICOMSegmentGrid segmentGridOf(const DICOMFile& file);
}

#endif

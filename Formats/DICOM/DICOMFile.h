// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the header of one DICOM file says of its images.
///
/// Positions are in the patient's frame of DICOM, LPS: x to the patient's left, y to the back, z to
/// the head, in mm. The patient's name and number are not read.
#ifndef BrainShift_DICOMFile_h
#define BrainShift_DICOMFile_h

#include "Formats/Volumes/VolumeFile.h"

#include <cstdint>

namespace brainshift
{
/** What tells images of the same place apart, in the order in which they are sorted. */
struct DICOMMoment
{
  double temporalPosition = 0.0; ///< number of the point in time
  double triggerMs = 0.0;        ///< since the heart's beat
  double echo = 0.0;             ///< number of the echo, or its time in ms
  double bValue = 0.0;           ///< diffusion weighting, s/mm^2
  double acquiredS = 0.0;        ///< since 1970, or since midnight
  double instance = 0.0;         ///< number of the image in its series
  double intervalS = 0.0;        ///< from one volume to the next: resolution or repetition time

  std::array<double, 6> sorted() const
  {
    return { this->temporalPosition, this->triggerMs, this->echo, this->bValue, this->acquiredS,
      this->instance };
  }
};

/** One image: a file of its own, or one of the frames of a file. */
struct DICOMFrame
{
  std::size_t file = 0; ///< index in the folder's list
  int frame = 0;        ///< index in the file
  bool isPlaced = false;
  glm::dvec3 position{ 0.0 };              ///< centre of the first pixel, mm, LPS
  glm::dvec3 alongRow{ 1.0, 0.0, 0.0 };    ///< unit vector: where columns count up
  glm::dvec3 alongColumn{ 0.0, 1.0, 0.0 }; ///< unit vector: where rows count up
  glm::dvec2 spacingMm{ 1.0 };             ///< between columns, between rows
  double sliceStepMm = 1.0;                ///< what the header says; positions count before it
  Rescaling rescaling;
  std::string type; ///< such as ORIGINAL\PRIMARY\M
  DICOMMoment moment;
};

/** How the numbers of a file are stored. */
struct DICOMPixelFormat
{
  int bitsAllocated = 0;
  int bitsStored = 0;
  int highBit = 0;
  bool isSigned = false;
  bool isPlain = false;     ///< whether the bytes of frames follow each other from `offset` on
  bool isBigEndian = false; ///< the order of bytes, if it is plain
  bool isDeflated = false;  ///< whether `offset` counts bytes after inflating
  std::uint64_t offset = 0; ///< of the pixel data, bytes
  std::uint64_t length = 0; ///< of the pixel data, bytes, if it is plain
};

/** The images of one file. */
struct DICOMFile
{
  std::string path;
  std::string series;      ///< SeriesInstanceUID
  std::string instance;    ///< SOPInstanceUID
  std::string description; ///< SeriesDescription
  std::string modality;
  std::string date; ///< 2026-11-23, or empty
  int seriesNumber = 0;
  int columns = 0;
  int rows = 0;
  DICOMPixelFormat pixels;
  std::string problem; ///< why the pixels cannot be read: the end of a sentence; empty if they can
  bool isDamaged = false;         ///< its header cannot be read
  bool standsAlone = false;       ///< its frames have no positions of their own
  std::vector<DICOMFrame> frames; ///< empty if the file holds no image
};

/** Whether a file exists and begins as DICOM does. */
bool isDICOMFile(const std::string& path);

/**
 * Reads the header of a file, up to its pixels: the image of a slice file, or the frames of a
 * multi-frame file with their functional groups. It has no frames if the file is damaged or holds
 * no image.
 */
DICOMFile readDICOMHeader(const std::string& path);
}

#endif

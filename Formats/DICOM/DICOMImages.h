// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the header of one DICOM file says of its images.
///
/// Positions are in the patient's frame of DICOM, LPS: x to the patient's left, y to the back, z to
/// the head, in mm. The patient's name and number are not read.
#ifndef BrainShift_DICOMImages_h
#define BrainShift_DICOMImages_h

#include "Formats/Volumes/VolumeFile.h"

#include <cstdint>
#include <optional>

namespace brainshift
{
/**
 * What tells images of the same place apart, in the order in which they are sorted. Triggers that
 * differ from place to place come last.
 */
struct DICOMMoment
{
  double temporalPosition = 0.0; ///< number of the point in time
  double triggerMs = 0.0;        ///< since the heart's beat
  bool isTriggerShared = true;   ///< whether images at all places have the same triggers
  double echo = 0.0;             ///< number of the echo
  double bValue = 0.0;           ///< diffusion weighting, s/mm^2
  /// Times of echo and inversion in ms, flip angle in degrees, voltage of the tube in kV.
  std::array<double, 4> settings{};
  double acquiredS = 0.0;      ///< since 1970, or since midnight
  double referenceS = 0.0;     ///< FrameReferenceTime of PET
  double instance = 0.0;       ///< number of the image in its series
  double intervalS = 0.0;      ///< from one volume to the next: resolution or repetition time
  double offsetS = 0.0;        ///< of the point in time, from the first one
  bool isTimed = false;        ///< whether the file says `acquiredS`
  bool isTimedByFrame = false; ///< whether the frame says it itself, and not its file for all
  bool isContentTime = false;  ///< `acquiredS` is when the image was made: no other time is there
  double contentS = -1.0;      ///< when the image was made, since 1970; below 0: not known

  std::array<double, 12> sorted() const
  {
    const double sharedMs = this->isTriggerShared ? this->triggerMs : 0.0;
    return { this->temporalPosition, sharedMs, this->echo, this->bValue, this->settings[0],
      this->settings[1], this->settings[2], this->settings[3], this->acquiredS, this->referenceS,
      this->instance, this->triggerMs };
  }

  /** Whether echo, diffusion weighting and settings are those of another image. */
  bool hasSettingsOf(const DICOMMoment& other) const
  {
    return this->echo == other.echo && this->bValue == other.bValue &&
      this->settings == other.settings;
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
  double betweenSlicesMm = 0.0;            ///< SpacingBetweenSlices; 0: not said
  bool knowsStep = false;                  ///< whether the header says it
  std::optional<double> locationMm;        ///< SliceLocation, which positions count before
  Rescaling rescaling;
  std::string quantity;      ///< what the numbers mean: Units and RescaleType, or real values
  bool isParametric = false; ///< real values count (RealWorldValueMappingSequence)
  std::string measured;      ///< in a parametric map, for a name: "ADC in mm2/s"
  std::string unit;          ///< in a parametric map
  std::string stack;         ///< StackID, in a multi-frame file
  int segment = 0;           ///< ReferencedSegmentNumber, in a segmentation; 0: none
  std::string type;          ///< such as ORIGINAL\PRIMARY\M
  DICOMMoment moment;
};

/** How pixels are colours (PhotometricInterpretation). */
enum class DICOMColors
{
  None, ///< grey
  RGB,
  YBR,    ///< brightness and two differences
  Palette ///< numbers of a table
};

/** How the numbers of a file are stored. */
struct DICOMPixelFormat
{
  int bitsAllocated = 0;
  int bitsStored = 0;
  int highBit = 0;
  bool isSigned = false;
  bool isReal = false; ///< floating point
  DICOMColors colors = DICOMColors::None;
  bool isPlanar = false;    ///< all red pixels, then all green ones, then all blue ones
  bool asLuminance = false; ///< colours are handed out as one number
  bool isPlain = false;     ///< whether the bytes of frames follow each other from `offset` on
  bool isBigEndian = false; ///< the order of bytes, if it is plain
  /// Numbers of 1 byte in words whose high byte comes first: the second of two pixels is before
  /// the first (PS3.5, 8.1.1 and A.3).
  bool areExchanged = false;
  bool isDeflated = false;  ///< whether `offset` counts bytes after inflating
  std::uint64_t offset = 0; ///< of the pixel data, bytes
  std::uint64_t length = 0; ///< of the pixel data, bytes, if it is plain
};

/** What the pixels of a segmentation are (SegmentationType). */
enum class SegmentKind
{
  None,       ///< no segmentation
  Binary,     ///< 1 where the segment of the frame is
  Fractional, ///< how much of a voxel belongs to it, or how likely, up to DICOMSegments::most
  LabelMap    ///< numbers of segments
};

/** What a segmentation says of its segments. */
struct DICOMSegments
{
  SegmentKind kind = SegmentKind::None;
  int most = 1;              ///< MaximumFractionalValue: this number is all of a voxel
  int background = 0;        ///< of a LabelMap (PixelPaddingValue): in no segment
  std::vector<Label> labels; ///< of the segments, by their numbers
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
  int columns = 0; ///< of a frame
  int rows = 0;
  /// Across and down the picture of a mosaic, whose frames are its tiles; 1: it is none.
  glm::ivec2 tiles{ 1 };
  DICOMPixelFormat pixels;
  std::string space;    ///< FrameOfReferenceUID
  std::string sopClass; ///< SOPClassUID
  DICOMSegments segments;
  std::vector<std::array<unsigned char, 3>> palette; ///< red, green, blue
  int firstOfPalette = 0;                            ///< the number of its first colour
  /// What may be wrong, or is not shown: ends of sentences.
  std::vector<std::string> notes;
  std::string problem; ///< why the pixels cannot be read: the end of a sentence; empty if they can
  bool isDamaged = false;         ///< its header cannot be read
  bool smallIsBright = false;     ///< MONOCHROME1, or the shape INVERSE
  bool standsAlone = false;       ///< its frames have no positions of their own
  std::vector<DICOMFrame> frames; ///< empty if the file holds no image
};

}

#endif

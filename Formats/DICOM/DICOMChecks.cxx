// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/DICOM/DICOMChecks.h"

#include "Formats/DICOM/DICOMAttributes.h"
#include "Formats/DICOM/DICOMFrames.h"
#include "Formats/Files/Text.h"

#include <iomanip>

namespace brainshift
{
namespace
{
bool has(const DICOMDataSet& set, DICOMTag tag)
{
  return set.elements.count(tag) > 0;
}

// Grey, or colours that readColors reads.
void requireShown(const DICOMDataSet& set)
{
  const double samples = wholeOf(set, 0x00280002, 1.0);
  const std::string colors = shownWords(textOf(set, 0x00280004));
  const bool isOne = colors.empty() || colors == "MONOCHROME1" || colors == "MONOCHROME2" ||
    colors == "PALETTE COLOR";
  const bool areThree = colors == "RGB" || colors == "YBR_FULL";
  if ((samples != 1.0 || !isOne) && (samples != 3.0 || !areThree))
  {
    throw Problem(joined("has ", samples,
      " samples per pixel (SamplesPerPixel) with the "
      "PhotometricInterpretation '",
      colors,
      "'; BrainShift reads MONOCHROME1, MONOCHROME2 and "
      "PALETTE COLOR with 1, RGB and YBR_FULL with 3"));
  }
}

// Segments have bits or bytes; numbers of labels may have two bytes.
void requireSegmentBits(const DICOMPixelFormat& pixels, SegmentKind segments)
{
  const int bits = pixels.bitsAllocated;
  const bool isRight = segments == SegmentKind::Binary ? bits == 1 || bits == 8
    : segments == SegmentKind::Fractional              ? bits == 8
                                                       : bits == 8 || bits == 16;
  if (!isRight || pixels.isReal || pixels.isSigned || pixels.bitsStored != bits ||
    pixels.highBit != bits - 1)
  {
    throw Problem(joined("has segments in pixels of ", bits, " bits, of which ", pixels.bitsStored,
      " are stored", pixels.isSigned ? ", with a sign" : "", pixels.isReal ? ", floating" : "",
      "; BINARY has 1 or 8 bits, FRACTIONAL 8, LABELMAP 8 or 16, all of them stored, without a "
      "sign"));
  }
}

void requireBits(const DICOMDataSet& set, const DICOMPixelFormat& pixels, SegmentKind segments)
{
  if (segments != SegmentKind::None)
  {
    requireSegmentBits(pixels, segments);
    return;
  }
  const int bits = pixels.bitsAllocated;
  if (pixels.isReal && bits != 32 && bits != 64)
  {
    throw Problem("has " + std::to_string(bits) +
      " bits for each pixel in floating point (BitsAllocated); it must have 32 or 64");
  }
  if (pixels.isReal)
  {
    return; // they have no stored bits and no sign of their own
  }
  if (bits != 8 && bits != 16 && bits != 32)
  {
    throw Problem("has " + std::to_string(bits) +
      " bits for each pixel (BitsAllocated); BrainShift reads 8, 16 and 32 bits");
  }
  if (pixels.bitsStored < 1 || pixels.highBit + 1 < pixels.bitsStored || pixels.highBit >= bits)
  {
    throw Problem("stores " + std::to_string(pixels.bitsStored) + " bits (BitsStored) up to bit " +
      std::to_string(pixels.highBit) + " (HighBit) of " + std::to_string(bits) +
      ", which cannot be");
  }
  const double sign = wholeOf(set, 0x00280103, 0.0);
  if (sign != 0.0 && sign != 1.0)
  {
    throw Problem(joined(
      "has the PixelRepresentation ", sign, "; it must be 0, without a sign, or 1, with a sign"));
  }
}

// Sequences that give numbers or frames another meaning than a volume has.
void requireVolume(const DICOMDataSet& set, SegmentKind kind)
{
  if (!itemsOf(set, 0x00283000).empty())
  {
    throw Problem(
      "has a ModalityLUTSequence, a table of the real values of its numbers. BrainShift "
      "reads RescaleSlope and RescaleIntercept");
  }
  const std::string segments = textOf(set, 0x00620001);
  if (!segments.empty() && segments != "LABELMAP" && kind == SegmentKind::None)
  {
    throw Problem("has frames of segments (SegmentationType " + shownWords(segments) +
      ") in an image of another class than a segmentation (SOPClassUID " +
      shownWords(textOf(set, 0x00080016)) + "). Convert it to .nii.gz or .seg.nrrd");
  }
  bool isSlide = textOf(set, 0x00080060) == "SM" ||      // Modality
    textOf(set, 0x00209311).compare(0, 5, "TILED") == 0; // DimensionOrganizationType
  for (const DICOMTag groups : { SharedGroups, FrameGroups })
  {
    const auto& items = itemsOf(set, groups);
    isSlide = isSlide || (!items.empty() && has(items.front(), 0x0048021a));
    if (!items.empty() && has(items.front(), 0x0020930e))
    {
      throw Problem(
        "has frames on the axes of its own volume (PlanePositionVolumeSequence), not of "
        "the patient, which BrainShift does not read");
    }
  }
  if (isSlide)
  {
    throw Problem("has tiles of a slide under a microscope, which have no position in a patient. "
                  "Open it in a viewer of slides");
  }
}

// Numbers are kept; who shows them must know which are bright.
void noteInverse(const DICOMDataSet& set, const DICOMFile& file, std::vector<std::string>& notes)
{
  const bool isInverse = textOf(set, 0x20500020) == "INVERSE";
  if (file.smallIsBright)
  {
    addNote(notes,
      std::string("has small numbers that are bright (") +
        (isInverse ? "PresentationLUTShape INVERSE" : "PhotometricInterpretation MONOCHROME1") +
        "). They are kept as stored: invert the colour map to see them as on a station");
  }
}

// Padding that is brighter than tissue may be.
void notePadding(
  const DICOMDataSet& set, const DICOMPixelFormat& pixels, std::vector<std::string>& notes)
{
  const double stored = wholeOf(set, 0x00280120, 0.0);
  const double half = 1 << 15;
  const double padding = pixels.isSigned && stored >= half ? stored - 2.0 * half : stored;
  if (padding > 0.0)
  {
    addNote(notes,
      joined("marks pixels outside the image by the stored number ", padding,
        " (PixelPaddingValue), which is shown like any other"));
  }
}
}

void requireOnce(const std::vector<DICOMTag>& repeated)
{
  if (!repeated.empty())
  {
    std::ostringstream tag;
    tag << std::hex << std::setfill('0') << std::setw(4) << (repeated.front() >> 16) << ","
        << std::setw(4) << (repeated.front() & 0xffff);
    throw Problem(twice("attribute (" + tag.str() + ")") + ", with different values");
  }
}

void requirePixels(const DICOMDataSet& set, const DICOMPixelFormat& pixels, SegmentKind segments)
{
  requireShown(set);
  requireVolume(set, segments);
  requireBits(set, pixels, segments);
}

std::vector<std::string> notesOf(const DICOMDataSet& set, const DICOMFile& file)
{
  std::vector<std::string> notes;
  if (textOf(set, 0x00102210) == "QUADRUPED")
  {
    addNote(notes,
      "is of an animal on four legs (AnatomicalOrientationType QUADRUPED): the letters P "
      "and S stand for its back (dorsal) and its nose (rostral or cranial)");
  }
  if (textOf(set, 0x00089206) == "DISTORTED")
  {
    addNote(notes,
      "has images that are distorted in space (VolumetricProperties DISTORTED): "
      "distances and positions are not those of the patient");
  }
  if (textOf(set, 0x00280004).empty())
  {
    addNote(notes, "does not say its PhotometricInterpretation, which counts as MONOCHROME2");
  }
  noteInverse(set, file, notes);
  if (file.segments.kind == SegmentKind::None)
  {
    notePadding(set, file.pixels, notes);
  }
  else if (file.segments.background > 0)
  {
    addNote(notes,
      joined("marks voxels that are in no segment by ", file.segments.background,
        " (PixelPaddingValue); slices without a frame have it, too"));
  }
  return notes;
}
}

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The bytes of a DICOM file, and its attributes up to its pixels.
///
/// Values of private groups are skipped, apart from those that tell Siemens' mosaics, and those of
/// the patient's group (0010) unless a user asked for them, apart from AnatomicalOrientationType,
/// which says what the axes mean.
#ifndef BrainShift_DICOMDataSet_h
#define BrainShift_DICOMDataSet_h

#include "Common/Problem.h"

#include <cstdint>
#include <fstream>
#include <map>
#include <vector>

namespace brainshift
{
/** Reads anywhere in a file. Nothing is read behind its end. */
class DICOMBytes
{
public:
  /** What is inflated is kept up to `mostInflated` bytes; bytes behind them cannot be read. */
  explicit DICOMBytes(const std::string& path, std::uint64_t mostInflated = MostInflated);

  /** More than any file has, and what a header has. */
  static constexpr std::uint64_t MostInflated = std::uint64_t(1) << 31;
  static constexpr std::uint64_t MostOfHeader = std::uint64_t(1) << 26;

  /** Bytes that there are; MostInflated if more is deflated than is kept. */
  std::uint64_t size() const { return this->Size; }

  /** Copies bytes. False if there are not as many. */
  bool read(std::uint64_t offset, std::uint64_t count, void* to);

  /** A few bytes, kept until the next call; null if there are not as many. */
  const unsigned char* at(std::uint64_t offset, std::size_t count);

  /**
   * Unpacks what is kept from an offset on, which then follows what is before it. False if it
   * cannot.
   */
  bool inflateFrom(std::uint64_t offset);

private:
  std::ifstream Stream;
  std::uint64_t Size = 0;
  std::uint64_t Kept = MostInflated;
  std::string Inflated; // all bytes, if some were deflated
  bool IsInflated = false;
  std::vector<unsigned char> Window;
  std::uint64_t WindowOffset = 0;
};

/** Group and element, such as 0x00280010. */
using DICOMTag = std::uint32_t;

struct DICOMElement;

/** Attributes by their tags. */
struct DICOMDataSet
{
  std::map<DICOMTag, DICOMElement> elements;
  bool isBigEndian = false; ///< the numbers in values
};

/** A value as it is stored, or the items of a sequence. */
struct DICOMElement
{
  std::uint32_t length = 0; ///< bytes in the file; of more than 1 MiB none are kept
  std::string bytes;
  std::vector<DICOMDataSet> items;
};

/** What stands before the pixels of a file. */
struct DICOMContent
{
  std::string transferSyntax; ///< its UID
  DICOMDataSet set;
  std::uint64_t end = 0;          ///< offset where the attributes end, or are damaged, bytes
  std::uint64_t pixelOffset = 0;  ///< 0: there are no pixels
  std::uint64_t pixelLength = 0;  ///< bytes, unless it is packed
  bool isPacked = false;          ///< the pixels come in fragments
  bool areWords = false;          ///< the pixels are words of 2 bytes (VR OW)
  bool areReal = false;           ///< the pixels are in floating point
  std::vector<DICOMTag> repeated; ///< attributes that occur twice with different values
};

/** What becomes of the patient's group (0010). */
enum class PatientGroup
{
  Skipped,
  Kept
};

/**
 * Reads up to the pixels. Bytes that are deflated are inflated in `bytes`. False if the file is
 * damaged: if a length leads behind the end of what holds it, for example.
 */
bool parseDICOM(
  DICOMBytes& bytes, DICOMContent& content, PatientGroup patient = PatientGroup::Skipped);

/**
 * The packed frames of a file: each of one fragment, or of several by the offset table. Empty if
 * the fragments are damaged or do not make up so many frames.
 */
std::vector<std::string> packedFrames(
  DICOMBytes& bytes, const DICOMContent& content, std::size_t frames);
}

#endif

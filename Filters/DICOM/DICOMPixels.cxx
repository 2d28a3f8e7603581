// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/DICOM/DICOMPixels.h"

#include "Filters/DICOM/DICOMAttributes.h"
#include "Filters/DICOM/DICOMDataSet.h"
#include "Filters/DICOM/DICOMRunLengths.h"

#include <gdcmDataElement.h>
#include <gdcmFragment.h>
#include <gdcmImage.h>
#include <gdcmPixelFormat.h>
#include <gdcmSequenceOfFragments.h>
#include <gdcmSmartPointer.h>
#include <gdcmTrace.h>
#include <gdcmTransferSyntax.h>

#include <algorithm>
#include <filesystem>
#include <mutex>
#include <sstream>
#include <system_error>
#include <type_traits>

namespace brainshift
{
namespace
{
std::size_t pixelsOf(const DICOMFile& file)
{
  return static_cast<std::size_t>(file.rows) * static_cast<std::size_t>(file.columns);
}

// Brings the stored bits to the lower end, with the sign of the highest. Other bits may hold
// drawings over the picture.
template <typename T>
void keepStoredBits(const DICOMPixelFormat& pixels, T* numbers, std::size_t count)
{
  if (pixels.bitsStored == pixels.bitsAllocated)
  {
    return;
  }
  const int unusedAbove = pixels.bitsAllocated - 1 - pixels.highBit;
  const int unused = pixels.bitsAllocated - pixels.bitsStored;
  for (std::size_t i = 0; i < count; ++i)
  {
    const auto bits = static_cast<std::make_unsigned_t<T>>(numbers[i]);
    numbers[i] = static_cast<T>(
      static_cast<T>(static_cast<std::make_unsigned_t<T>>(bits << unusedAbove)) >> unused);
  }
}

template <typename From>
void convert(const From* from, std::size_t count, const DICOMTarget& target, int type)
{
  if (type == VTK_FLOAT)
  {
    const Rescaling& rescaling = target.frame->rescaling;
    auto* to = static_cast<float*>(target.numbers);
    for (std::size_t i = 0; i < count; ++i)
    {
      to[i] =
        static_cast<float>(rescaling.slope * static_cast<double>(from[i]) + rescaling.intercept);
    }
    return;
  }
  const auto copyTo = [&](auto* to) {
    using To = std::remove_reference_t<decltype(*to)>;
    for (std::size_t i = 0; i < count; ++i)
    {
      to[i] = static_cast<To>(static_cast<std::int64_t>(static_cast<double>(from[i])));
    }
  };
  switch (type)
  {
    case VTK_UNSIGNED_CHAR:
      return copyTo(static_cast<unsigned char*>(target.numbers));
    case VTK_SIGNED_CHAR:
      return copyTo(static_cast<signed char*>(target.numbers));
    case VTK_UNSIGNED_SHORT:
      return copyTo(static_cast<unsigned short*>(target.numbers));
    case VTK_SHORT:
      return copyTo(static_cast<short*>(target.numbers));
    case VTK_UNSIGNED_INT:
      return copyTo(static_cast<unsigned int*>(target.numbers));
    default:
      return copyTo(static_cast<int*>(target.numbers));
  }
}

// Calls use(null pointer to T), T being the type with a number of VTK.
template <typename Use>
void withStoredType(int type, const Use& use)
{
  switch (type)
  {
    case VTK_UNSIGNED_CHAR:
      return use(static_cast<unsigned char*>(nullptr));
    case VTK_SIGNED_CHAR:
      return use(static_cast<signed char*>(nullptr));
    case VTK_UNSIGNED_SHORT:
      return use(static_cast<unsigned short*>(nullptr));
    case VTK_SHORT:
      return use(static_cast<short*>(nullptr));
    case VTK_UNSIGNED_INT:
      return use(static_cast<unsigned int*>(nullptr));
    default:
      return use(static_cast<int*>(nullptr));
  }
}

// GDCM writes to the console what the reader says itself.
void silenceGDCM()
{
  static std::once_flag once;
  std::call_once(once, [] {
    gdcm::Trace::DebugOff();
    gdcm::Trace::WarningOff();
    gdcm::Trace::ErrorOff();
  });
}

template <typename T>
void swapBytes(T* numbers, std::size_t count)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    auto* bytes = reinterpret_cast<unsigned char*>(numbers + i);
    std::reverse(bytes, bytes + sizeof(T));
  }
}

// Frames whose bytes follow each other go straight to their place.
std::string readPlain(const DICOMFile& file, const std::vector<DICOMTarget>& targets, int type)
{
  DICOMBytes stream(file.path);
  DICOMContent content;
  if (file.pixels.isDeflated && !parseDICOM(stream, content))
  {
    return file.path + " is damaged: it cannot be inflated";
  }
  const std::size_t count = pixelsOf(file);
  const std::uint64_t bytes = count * (file.pixels.bitsAllocated / 8);
  const int stored = storedTypeOf(file.pixels);
  std::vector<char> buffer(type == stored ? 0 : bytes);
  for (const DICOMTarget& target : targets)
  {
    const std::uint64_t begin = bytes * target.frame->frame;
    char* to = buffer.empty() ? static_cast<char*>(target.numbers) : buffer.data();
    if (!stream.read(file.pixels.offset + begin, bytes, to))
    {
      return file.path + " ended while it was read";
    }
    withStoredType(stored, [&](auto* none) {
      auto* numbers = reinterpret_cast<decltype(none)>(to);
      if (file.pixels.isBigEndian)
      {
        swapBytes(numbers, count);
      }
      keepStoredBits(file.pixels, numbers, count);
      if (!buffer.empty())
      {
        convert(numbers, count, target, type);
      }
    });
  }
  return {};
}

int decodedTypeOf(const gdcm::PixelFormat& format)
{
  switch (format.GetScalarType())
  {
    case gdcm::PixelFormat::UINT8:
      return VTK_UNSIGNED_CHAR;
    case gdcm::PixelFormat::INT8:
      return VTK_SIGNED_CHAR;
    case gdcm::PixelFormat::UINT12: // unpacked to 16 bits
    case gdcm::PixelFormat::UINT16:
      return VTK_UNSIGNED_SHORT;
    case gdcm::PixelFormat::INT12:
    case gdcm::PixelFormat::INT16:
      return VTK_SHORT;
    case gdcm::PixelFormat::UINT32:
      return VTK_UNSIGNED_INT;
    case gdcm::PixelFormat::INT32:
      return VTK_INT;
    default:
      return VTK_VOID;
  }
}

// Whether a JPEG or JPEG-LS frame holds what the header of the file says. GDCM ends the program at
// some that do not. JPEG 2000 begins in another way.
bool isFrameOf(const DICOMFile& file, const std::string& packed)
{
  const auto at = [&packed](std::size_t i) { return static_cast<unsigned char>(packed[i]); };
  std::size_t offset = 2; // behind the marker that begins a frame
  while (offset + 10 <= packed.size() && at(offset) == 0xff)
  {
    const int marker = at(offset + 1);
    // Sequential, lossless, and JPEG-LS.
    const bool isFrame = marker == 0xc0 || marker == 0xc1 || marker == 0xc3 || marker == 0xf7;
    if (isFrame)
    {
      const int bits = at(offset + 4);
      return bits >= 2 && bits <= file.pixels.bitsAllocated &&
        (at(offset + 5) << 8 | at(offset + 6)) == file.rows &&
        (at(offset + 7) << 8 | at(offset + 8)) == file.columns && at(offset + 9) == 1;
    }
    offset += 2 + (at(offset + 2) << 8 | at(offset + 3));
  }
  return false;
}

gdcm::SmartPointer<gdcm::SequenceOfFragments> fragmentOf(const std::string& packed)
{
  gdcm::Fragment fragment;
  fragment.SetByteValue(packed.data(), static_cast<std::uint32_t>(packed.size()));
  gdcm::SmartPointer<gdcm::SequenceOfFragments> fragments = new gdcm::SequenceOfFragments;
  fragments->AddFragment(fragment);
  return fragments;
}

// One frame, unpacked by GDCM. It is handed the fragment alone: Debian's GDCM ends the program at
// some files whose headers are damaged.
std::string unpack(const DICOMFile& file, const gdcm::TransferSyntax& syntax,
  const std::string& packed, const DICOMTarget& target, int type)
{
  const bool isJPEG = packed.compare(0, 2, "\xff\xd8") == 0;
  if (!isJPEG && packed.compare(0, 2, "\xff\x4f") != 0 &&
    packed.compare(0, 4, "\0\0\0\x0c", 4) != 0)
  {
    return file.path + " is damaged: a frame begins neither as JPEG nor as JPEG 2000";
  }
  if (isJPEG && !isFrameOf(file, packed))
  {
    return file.path + " is damaged: a frame has another size than the file";
  }
  const DICOMPixelFormat& format = file.pixels;
  const auto whole = [](int number) { return static_cast<unsigned short>(number); };
  gdcm::Image image;
  image.SetNumberOfDimensions(2);
  image.SetDimension(0, static_cast<unsigned int>(file.columns));
  image.SetDimension(1, static_cast<unsigned int>(file.rows));
  image.SetPhotometricInterpretation(gdcm::PhotometricInterpretation::MONOCHROME2);
  image.SetPixelFormat(gdcm::PixelFormat(1, whole(format.bitsAllocated), whole(format.bitsStored),
    whole(format.highBit), format.isSigned ? 1 : 0));
  image.SetTransferSyntax(syntax);
  gdcm::DataElement pixels(gdcm::Tag(0x7fe0, 0x0010));
  pixels.SetVR(gdcm::VR::OB);
  pixels.SetValue(*fragmentOf(packed));
  image.SetDataElement(pixels);
  const std::size_t count = pixelsOf(file);
  const std::size_t length = image.GetBufferLength();
  std::vector<char> buffer(length);
  const bool isUnpacked = length > 0 && image.GetBuffer(buffer.data());
  const int decoded = decodedTypeOf(image.GetPixelFormat());
  if (!isUnpacked || decoded == VTK_VOID)
  {
    return file.path + " is damaged: GDCM cannot unpack its pixels";
  }
  std::string problem;
  withStoredType(decoded, [&](auto* none) {
    const auto* numbers = reinterpret_cast<decltype(none)>(buffer.data());
    if (count * sizeof(*numbers) > length)
    {
      problem = file.path + " is damaged: its pixels unpack to another size";
      return;
    }
    convert(numbers, count, target, type);
  });
  return problem;
}

std::string unpackRuns(
  const DICOMFile& file, const std::string& packed, const DICOMTarget& target, int type)
{
  const std::size_t count = pixelsOf(file);
  std::string plain =
    unpackRunLengths(packed, count, static_cast<std::size_t>(file.pixels.bitsAllocated) / 8);
  if (plain.empty())
  {
    return file.path + " is damaged: its run lengths do not make up its pixels";
  }
  withStoredType(storedTypeOf(file.pixels), [&](auto* none) {
    auto* numbers = reinterpret_cast<decltype(none)>(plain.data());
    keepStoredBits(file.pixels, numbers, count);
    convert(numbers, count, target, type);
  });
  return {};
}

std::string decode(const DICOMFile& file, const std::vector<DICOMTarget>& targets, int type)
{
  silenceGDCM();
  DICOMBytes bytes(file.path);
  DICOMContent content;
  const bool isRead = parseDICOM(bytes, content) && content.isPacked;
  const gdcm::TransferSyntax::TSType syntax =
    gdcm::TransferSyntax::GetTSType(content.transferSyntax.c_str());
  if (!isRead || syntax == gdcm::TransferSyntax::TS_END)
  {
    return file.path + " is packed in a way that GDCM does not know, " +
      plainText(content.transferSyntax);
  }
  const std::vector<std::string> packed = packedFrames(bytes, content, file.frames.size());
  if (packed.empty())
  {
    return file.path + " is damaged: its fragments do not make up " +
      std::to_string(file.frames.size()) + " frames";
  }
  for (const DICOMTarget& target : targets)
  {
    const std::string& frame = packed[target.frame->frame];
    const std::string problem = syntax == gdcm::TransferSyntax::RLELossless
      ? unpackRuns(file, frame, target, type)
      : unpack(file, syntax, frame, target, type);
    if (!problem.empty())
    {
      return problem;
    }
  }
  return {};
}
}

int storedTypeOf(const DICOMPixelFormat& pixels)
{
  switch (pixels.bitsAllocated)
  {
    case 8:
      return pixels.isSigned ? VTK_SIGNED_CHAR : VTK_UNSIGNED_CHAR;
    case 32:
      return pixels.isSigned ? VTK_INT : VTK_UNSIGNED_INT;
    default: // 12 bits, too
      return pixels.isSigned ? VTK_SHORT : VTK_UNSIGNED_SHORT;
  }
}

std::string pixelDataProblem(const DICOMFile& file)
{
  const std::uint64_t need =
    file.pixels.isPlain ? pixelsOf(file) * (file.pixels.bitsAllocated / 8) * file.frames.size() : 0;
  std::error_code error;
  const std::uintmax_t size = need > 0 ? std::filesystem::file_size(file.path, error) : 0;
  std::uint64_t rest = size > file.pixels.offset ? size - file.pixels.offset : 0;
  rest = file.pixels.isDeflated ? file.pixels.length : rest;
  const std::uint64_t has = std::min<std::uint64_t>(rest, file.pixels.length);
  if (has >= need)
  {
    return {};
  }
  std::ostringstream text;
  text << file.path << " has " << has << " bytes of pixel data; " << file.columns << " x "
       << file.rows << " pixels of " << file.pixels.bitsAllocated << " bits in "
       << file.frames.size() << " frames need " << need;
  return text.str();
}

std::string readDICOMPixels(
  const DICOMFile& file, const std::vector<DICOMTarget>& targets, int type)
{
  return file.pixels.isPlain ? readPlain(file, targets, type) : decode(file, targets, type);
}
}

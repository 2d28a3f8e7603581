// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/DICOM/DICOMPixels.h"

#include "Common/Bytes.h"
#include "Formats/DICOM/DICOMAttributes.h"
#include "Formats/DICOM/DICOMColors.h"
#include "Formats/Files/Text.h"
#include "Formats/PackedFrames/PackedFrame.h"

#include "vtkDataArray.h"

#include <algorithm>
#include <filesystem>
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
  if constexpr (std::is_integral_v<T>)
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
}

// Where the numbers of a frame lie that has so many bits: a frame of fewer than the file says has
// them at the lower end, with its own highest bit as the sign.
DICOMPixelFormat formatOf(const DICOMPixelFormat& pixels, const UnpackedFrame& frame)
{
  DICOMPixelFormat format = pixels;
  if (frame.bits > 0 && !frame.isSigned && frame.bits <= pixels.bitsStored)
  {
    format.bitsStored = frame.bits;
    format.highBit = frame.bits - 1;
  }
  return format;
}

// A lossy frame may hold more than the brightest stored number, which must not become dark.
template <typename T>
void clampToStoredBits(const DICOMPixelFormat& pixels, T* numbers, std::size_t count)
{
  if (pixels.highBit + 1 < pixels.bitsAllocated)
  {
    const int bits = pixels.isSigned ? pixels.highBit : pixels.highBit + 1;
    const T most = static_cast<T>((std::uint32_t(1) << bits) - 1);
    const T least = static_cast<T>(pixels.isSigned ? -1 - static_cast<std::int64_t>(most) : 0);
    std::transform(numbers, numbers + count, numbers,
      [least, most](T number) { return std::clamp(number, least, most); });
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
    case VTK_FLOAT:
      return use(static_cast<float*>(nullptr));
    case VTK_DOUBLE:
      return use(static_cast<double*>(nullptr));
    default:
      return use(static_cast<int*>(nullptr));
  }
}

// Bytes of the pixel data, in the order of the pixels.
bool readPixelBytes(DICOMBytes& stream, const DICOMPixelFormat& pixels, std::uint64_t begin,
  std::uint64_t count, char* to)
{
  if (!pixels.areExchanged)
  {
    return stream.read(pixels.offset + begin, count, to);
  }
  const std::uint64_t first = begin & ~std::uint64_t(1);
  std::vector<char> words(((begin + count + 1) & ~std::uint64_t(1)) - first);
  if (!stream.read(pixels.offset + first, words.size(), words.data()))
  {
    return false;
  }
  for (std::uint64_t i = 0; i < count; ++i)
  {
    to[i] = words[(begin + i - first) ^ 1];
  }
  return true;
}

// Bits become numbers of 1 byte. The lowest bit of a byte is the first pixel (PS3.5, 8.1.1).
void expandBits(const std::vector<char>& packed, std::size_t firstBit, std::size_t count, void* to)
{
  auto* numbers = static_cast<unsigned char*>(to);
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::size_t bit = firstBit + i;
    numbers[i] = static_cast<unsigned char>(packed[bit / 8]) >> bit % 8 & 1;
  }
}

// A frame of bits begins where the last one ended, which may be inside a byte.
void readBits(const DICOMFile& file, DICOMBytes& stream, const DICOMTarget& target)
{
  const std::size_t count = pixelsOf(file);
  const std::uint64_t first = count * static_cast<std::uint64_t>(target.frame->frame);
  std::vector<char> packed((first % 8 + count + 7) / 8);
  if (!readPixelBytes(stream, file.pixels, first / 8, packed.size(), packed.data()))
  {
    throw Problem(file.path + " ended while it was read");
  }
  expandBits(packed, first % 8, count, target.numbers);
}

bool areRescaled(const std::vector<DICOMTarget>& targets)
{
  return std::any_of(targets.begin(), targets.end(),
    [](const DICOMTarget& target) { return target.frame->rescaling.isNeeded(); });
}

// Frames whose bytes follow each other go straight to their place.
void readPlain(const DICOMFile& file, const std::vector<DICOMTarget>& targets, int type)
{
  DICOMBytes stream(file.path);
  DICOMContent content;
  if (file.pixels.isDeflated && !parseDICOM(stream, content))
  {
    throw Problem(file.path + " is damaged: it cannot be inflated");
  }
  const std::size_t count = pixelsOf(file);
  const std::uint64_t bytes = count * static_cast<std::uint64_t>(bytesOfPixel(file.pixels));
  const bool areColors = file.pixels.colors != DICOMColors::None;
  const int stored = storedTypeOf(file.pixels);
  const bool isStraight =
    type == stored && !areColors && !(type == VTK_FLOAT && areRescaled(targets));
  std::vector<char> buffer(isStraight ? 0 : bytes);
  for (const DICOMTarget& target : targets)
  {
    if (file.pixels.bitsAllocated == 1)
    {
      readBits(file, stream, target);
      continue;
    }
    const std::uint64_t begin = bytes * target.frame->frame;
    char* to = buffer.empty() ? static_cast<char*>(target.numbers) : buffer.data();
    if (!readPixelBytes(stream, file.pixels, begin, bytes, to))
    {
      throw Problem(file.path + " ended while it was read");
    }
    if (areColors)
    {
      const auto size = static_cast<std::size_t>(file.pixels.bitsAllocated / 8);
      toMachineOrder(to, bytes / size, size, file.pixels.isBigEndian);
      paintColors(file, reinterpret_cast<unsigned char*>(to), target.numbers);
      continue;
    }
    withStoredType(stored, [&](auto* none) {
      auto* numbers = reinterpret_cast<decltype(none)>(to);
      toMachineOrder(to, count, sizeof(*numbers), file.pixels.isBigEndian);
      keepStoredBits(file.pixels, numbers, count);
      if (!buffer.empty())
      {
        convert(numbers, count, target, type);
      }
    });
  }
}

struct Packing
{
  UnpackedFrame (*unpack)(const std::string& packed, const FrameShape& shape) = nullptr;
  bool mayLose = false;
  bool keepsBytes = false; // pixels of 1 bit are packed as the bytes that they have without it
};

// The bits of a frame of bytes, as numbers.
void expandFrame(std::size_t count, UnpackedFrame& frame)
{
  const std::vector<char> packed(frame.numbers.begin(), frame.numbers.end());
  frame.numbers.resize(count);
  expandBits(packed, 0, count, frame.numbers.data());
}

// How frames of a transfer syntax are unpacked. Not named: the multi-component parts of JPEG 2000,
// videos, and syntaxes that the standard has withdrawn.
Packing packingOf(const std::string& transferSyntax)
{
  static const std::map<std::string, Packing> known = {
    { "1.2.840.10008.1.2.4.50", { unpackJPEG, true } },      // baseline
    { "1.2.840.10008.1.2.4.51", { unpackJPEG, true } },      // extended, 12 bits
    { "1.2.840.10008.1.2.4.57", { unpackJPEG, false } },     // lossless
    { "1.2.840.10008.1.2.4.70", { unpackJPEG, false } },     // lossless, first-order prediction
    { "1.2.840.10008.1.2.4.80", { unpackJPEGLS, false } },   // lossless
    { "1.2.840.10008.1.2.4.81", { unpackJPEGLS, true } },    // near-lossless
    { "1.2.840.10008.1.2.4.90", { unpackJPEG2000, false } }, // lossless
    { "1.2.840.10008.1.2.4.91", { unpackJPEG2000, true } },
    { "1.2.840.10008.1.2.5", { unpackRunLengths, false, true } },
    { "1.2.840.10008.1.2.8.1", { unpackDeflated, false, true } }, // frame by frame
  };
  const auto found = known.find(transferSyntax);
  return found == known.end() ? Packing() : found->second;
}

// One frame, with a byte for each bit, and three bytes in order for each colour.
UnpackedFrame unpackedFrame(
  const DICOMFile& file, const Packing& packing, const std::string& packed)
{
  const FrameShape shape{ file.columns, file.rows, std::max(file.pixels.bitsAllocated, 8) };
  if (file.pixels.bitsAllocated == 1 && packing.keepsBytes)
  {
    UnpackedFrame bits =
      packing.unpack(packed, { static_cast<int>((shape.count() + 7) / 8), 1, 8 });
    expandFrame(shape.count(), bits);
    return bits;
  }
  if (bytesOfPixel(file.pixels) != 3)
  {
    return packing.unpack(packed, shape);
  }
  UnpackedFrame colors = packing.unpack(packed, { file.columns, file.rows, 24 });
  for (std::size_t i = 0; i < colors.numbers.size(); i += 3) // they count as one number: blue first
  {
    std::swap(colors.numbers[i], colors.numbers[i + 2]);
  }
  return colors;
}

void decode(const DICOMFile& file, const std::vector<DICOMTarget>& targets, int type)
{
  DICOMBytes bytes(file.path);
  DICOMContent content;
  const bool isRead = parseDICOM(bytes, content);
  const Packing packing = isRead ? packingOf(content.transferSyntax) : Packing();
  if (packing.unpack && !content.isPacked)
  {
    throw Problem(file.path + " is damaged: its packed pixels do not come in fragments (" +
      plainText(content.transferSyntax) + ")");
  }
  if (!packing.unpack)
  {
    throw Problem(file.path + " is packed in a way that BrainShift does not know, " +
      plainText(content.transferSyntax));
  }
  const std::vector<std::string> packed = packedFrames(bytes, content, file.frames.size());
  if (packed.empty())
  {
    throw Problem(file.path + " is damaged: its fragments do not make up " +
      std::to_string(file.frames.size()) + " frames");
  }
  const std::size_t count = pixelsOf(file);
  for (const DICOMTarget& target : targets)
  {
    UnpackedFrame frame = withBeginning(file.path + " cannot be read: ",
      [&] { return unpackedFrame(file, packing, packed[target.frame->frame]); });
    if (frame.isSigned && !file.pixels.isSigned)
    {
      throw Problem(file.path +
        " cannot be read: a frame has signed numbers; the file says that they are "
        "not signed (Pixel Representation 0)");
    }
    if (file.pixels.colors != DICOMColors::None)
    {
      paintColors(
        file, reinterpret_cast<const unsigned char*>(frame.numbers.data()), target.numbers);
      continue;
    }
    const DICOMPixelFormat format = formatOf(file.pixels, frame);
    withStoredType(storedTypeOf(file.pixels), [&](auto* none) {
      auto* numbers = reinterpret_cast<decltype(none)>(frame.numbers.data());
      if (packing.mayLose && frame.isSigned == file.pixels.isSigned) // else: two's complement
      {
        clampToStoredBits(format, numbers, count);
      }
      keepStoredBits(format, numbers, count);
      convert(numbers, count, target, type);
    });
  }
}

// The picture of a mosaic, as if it were a slice.
DICOMFile pictureOf(const DICOMFile& mosaic)
{
  DICOMFile picture = mosaic;
  picture.columns *= mosaic.tiles.x;
  picture.rows *= mosaic.tiles.y;
  picture.tiles = glm::ivec2(1);
  picture.frames.resize(1);
  picture.frames.front().frame = 0;
  return picture;
}

void readTiles(const DICOMFile& file, const std::vector<DICOMTarget>& targets, int type)
{
  const DICOMFile picture = pictureOf(file);
  const auto bytes = static_cast<std::size_t>(vtkDataArray::GetDataTypeSize(type));
  std::vector<char> numbers(pixelsOf(picture) * bytes);
  readDICOMPixels(picture, { { &picture.frames.front(), numbers.data() } }, type);
  const auto tiles = static_cast<std::size_t>(file.tiles.x);
  const std::size_t rowBytes = bytes * static_cast<std::size_t>(file.columns);
  for (const DICOMTarget& target : targets)
  {
    const std::size_t tileRow = static_cast<std::size_t>(target.frame->frame) / tiles;
    const std::size_t tileColumn = static_cast<std::size_t>(target.frame->frame) % tiles;
    auto* to = static_cast<char*>(target.numbers);
    for (int row = 0; row < file.rows; ++row)
    {
      const std::size_t pictureRow =
        tileRow * static_cast<std::size_t>(file.rows) + static_cast<std::size_t>(row);
      const char* from = numbers.data() + (pictureRow * tiles + tileColumn) * rowBytes;
      to = std::copy_n(from, rowBytes, to);
    }
  }
}
}

int storedTypeOf(const DICOMPixelFormat& pixels)
{
  if (pixels.colors != DICOMColors::None)
  {
    return VTK_UNSIGNED_CHAR;
  }
  if (pixels.isReal)
  {
    return pixels.bitsAllocated == 64 ? VTK_DOUBLE : VTK_FLOAT;
  }
  switch (pixels.bitsAllocated)
  {
    case 1: // one byte for each bit
    case 8:
      return pixels.isSigned ? VTK_SIGNED_CHAR : VTK_UNSIGNED_CHAR;
    case 32:
      return pixels.isSigned ? VTK_INT : VTK_UNSIGNED_INT;
    default: // 12 bits, too
      return pixels.isSigned ? VTK_SHORT : VTK_UNSIGNED_SHORT;
  }
}

void requirePixelData(const DICOMFile& file)
{
  if (file.tiles != glm::ivec2(1))
  {
    requirePixelData(pictureOf(file));
    return;
  }
  const std::uint64_t pixels = pixelsOf(file) * file.frames.size();
  const std::uint64_t bytes = file.pixels.bitsAllocated == 1
    ? (pixels + 7) / 8
    : pixels * static_cast<std::uint64_t>(bytesOfPixel(file.pixels));
  const std::uint64_t need = file.pixels.isPlain ? bytes : 0;
  std::error_code error;
  const std::uintmax_t size = need > 0 ? std::filesystem::file_size(file.path, error) : 0;
  std::uint64_t rest = size > file.pixels.offset ? size - file.pixels.offset : 0;
  rest = file.pixels.isDeflated ? file.pixels.length : rest;
  const std::uint64_t has = std::min<std::uint64_t>(rest, file.pixels.length);
  if (has < need)
  {
    throw Problem(joined(file.path, " has ", has, " bytes of pixel data; ", file.columns, " x ",
      file.rows, " pixels of ", file.pixels.bitsAllocated, " bits in ", file.frames.size(),
      " frames need ", need));
  }
}

void readDICOMPixels(const DICOMFile& file, const std::vector<DICOMTarget>& targets, int type)
{
  if (file.tiles != glm::ivec2(1))
  {
    readTiles(file, targets, type);
  }
  else if (file.pixels.isPlain)
  {
    readPlain(file, targets, type);
  }
  else
  {
    decode(file, targets, type);
  }
}
}

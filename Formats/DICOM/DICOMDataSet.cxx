// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/DICOM/DICOMDataSet.h"

#include "Common/Bytes.h"

#include "vtk_zlib.h"

#include <set>
#include <utility>

namespace brainshift
{
namespace
{
constexpr std::uint64_t WindowBytes = 16384;

constexpr int DeepestSequence = 16;             // enhanced files have 3 levels
constexpr std::uint32_t LongestValue = 1 << 20; // bytes that are kept
constexpr std::uint32_t Undefined = 0xffffffff;
constexpr DICOMTag Item = 0xfffee000;
constexpr DICOMTag EndOfItem = 0xfffee00d;
constexpr DICOMTag EndOfSequence = 0xfffee0dd;
constexpr DICOMTag PixelData = 0x7fe00010;
constexpr DICOMTag FloatPixelData = 0x7fe00008;
constexpr DICOMTag DoubleFloatPixelData = 0x7fe00009;
constexpr DICOMTag AnatomicalOrientation = 0x00102210; // a word of the axes, not of the patient
constexpr DICOMTag TransferSyntax = 0x00020010;
const std::string Implicit = "1.2.840.10008.1.2";
const std::string BigEndian = "1.2.840.10008.1.2.2";
const std::string Deflated = "1.2.840.10008.1.2.1.99";

// How elements are written.
struct Form
{
  bool isExplicit = true;
  bool isBig = false;
  int depth = 0; // of the sequences around a set
};

struct Head
{
  DICOMTag tag = 0;
  char vr[2] = { 0, 0 };
  std::uint32_t length = 0;
  std::uint64_t value = 0; // its offset
};

DICOMTag tagAt(const unsigned char* bytes, const Form& form)
{
  return DICOMTag(storedNumber<std::uint16_t>(bytes, form.isBig)) << 16 |
    storedNumber<std::uint16_t>(bytes + 2, form.isBig);
}

// The sequence of a mosaic's slices by United Imaging, in whatever block.
bool isUnitedSlices(DICOMTag tag)
{
  return tag >> 16 == 0x0065 && (tag & 0xffff) > 0x1000 && (tag & 0xff) == 0x51;
}

// The attributes by which Siemens and United Imaging tell mosaics, in whatever block, and the names
// of blocks.
bool mayTellMosaic(DICOMTag tag)
{
  const DICOMTag group = tag >> 16;
  const DICOMTag element = tag & 0xffff;
  const bool isCreator = element >= 0x10 && element <= 0xff;
  const DICOMTag inBlock = element & 0xff;
  return (group == 0x0019 && (isCreator || inBlock == 0x0a)) ||
    (group == 0x0029 && (isCreator || inBlock == 0x10)) ||
    (group == 0x0051 && (isCreator || inBlock == 0x16)) ||
    (group == 0x0065 && (isCreator || inBlock == 0x50 || isUnitedSlices(tag)));
}

class Parser
{
public:
  explicit Parser(DICOMBytes& bytes, PatientGroup patient = PatientGroup::Skipped)
    : Bytes(bytes)
    , Patient(patient)
  {
  }

  bool head(std::uint64_t offset, const Form& form, Head& head)
  {
    const unsigned char* bytes = this->Bytes.at(offset, 8);
    if (!bytes)
    {
      return false;
    }
    head.tag = tagAt(bytes, form);
    head.value = offset + 8;
    head.vr[0] = head.vr[1] = 0;
    if (!form.isExplicit || head.tag >> 16 == 0xfffe)
    {
      head.length = storedNumber<std::uint32_t>(bytes + 4, form.isBig);
      return true;
    }
    std::memcpy(head.vr, bytes + 4, 2);
    if (head.vr[0] < 'A' || head.vr[0] > 'Z' || head.vr[1] < 'A' || head.vr[1] > 'Z')
    {
      return false;
    }
    static const std::set<std::string> Long{ "OB", "OD", "OF", "OL", "OV", "OW", "SQ", "SV", "UC",
      "UN", "UR", "UT", "UV" };
    head.length = storedNumber<std::uint16_t>(bytes + 6, form.isBig);
    if (Long.count(std::string(head.vr, 2)) > 0)
    {
      bytes = this->Bytes.at(offset, 12);
      head.length = bytes ? storedNumber<std::uint32_t>(bytes + 8, form.isBig) : 0;
      head.value = offset + 12;
    }
    return bytes != nullptr;
  }

  // Reads attributes until `end`, the end of an item, or the pixels; moves `offset` there.
  bool readSet(std::uint64_t& offset, std::uint64_t end, const Form& form, DICOMDataSet& set)
  {
    set.isBigEndian = form.isBig;
    while (offset < end)
    {
      Head found;
      if (!this->head(offset, form, found))
      {
        return false;
      }
      if (found.tag == EndOfItem)
      {
        offset = found.value;
        return true;
      }
      const bool arePixels =
        found.tag == PixelData || found.tag == FloatPixelData || found.tag == DoubleFloatPixelData;
      if (arePixels && form.depth == 0)
      {
        this->Pixels = found;
        return true;
      }
      offset = found.value;
      if (!this->readElement(offset, end, form, found, set))
      {
        return false;
      }
    }
    return offset == end;
  }

  Head Pixels;
  std::vector<DICOMTag> Repeated;

private:
  bool readElement(
    std::uint64_t& offset, std::uint64_t end, const Form& form, const Head& head, DICOMDataSet& set)
  {
    if (head.length != Undefined && head.length > end - offset)
    {
      return false;
    }
    const DICOMTag group = head.tag >> 16;
    if ((group == 0x0000 || group == 0x0002) && form.depth == 0)
    {
      return false; // commands are in no file, and the group of the file is first (PS3.10, 7.1)
    }
    const bool isPublic = group % 2 == 0;
    const bool isKept = isPublic
      ? group != 0x0010 || head.tag == AnatomicalOrientation || this->Patient == PatientGroup::Kept
      : form.depth == 0 && mayTellMosaic(head.tag);
    DICOMElement element;
    element.length = head.length;
    if (this->isSequence(offset, form, head))
    {
      Form inside = form;
      inside.depth = form.depth + 1;
      inside.isExplicit = form.isExplicit && !isUnknown(head);
      inside.isBig = form.isBig && !isUnknown(head);
      const std::uint64_t last = head.length == Undefined ? end : offset + head.length;
      if (form.depth >= DeepestSequence ||
        !this->readItems(offset, last, inside, head.length, element))
      {
        return false;
      }
    }
    else
    {
      if (isKept && head.length <= LongestValue)
      {
        element.bytes.resize(head.length);
        if (!this->Bytes.read(offset, head.length, element.bytes.data()))
        {
          return false;
        }
      }
      offset += head.length;
    }
    if (isKept)
    {
      const auto known = set.elements.find(head.tag);
      if (isPublic && known != set.elements.end() &&
        (known->second.length != element.length || known->second.bytes != element.bytes))
      {
        this->Repeated.push_back(head.tag);
      }
      set.elements[head.tag] = std::move(element);
    }
    return true;
  }

  bool isSequence(std::uint64_t offset, const Form& form, const Head& head)
  {
    if (head.length == Undefined || std::strncmp(head.vr, "SQ", 2) == 0)
    {
      return true;
    }
    // UN of a known length is bytes or items (PS3.5, 6.2.2); the items of a mosaic count.
    const bool mayHaveItems =
      !form.isExplicit || (isUnknown(head) && form.depth == 0 && isUnitedSlices(head.tag));
    const unsigned char* first =
      mayHaveItems && head.length >= 8 ? this->Bytes.at(offset, 4) : nullptr;
    Form inside = form;
    inside.isBig = form.isBig && !isUnknown(head);
    return first && tagAt(first, inside) == Item;
  }

  // Programs that do not know an attribute write it so, with what is in it as implicit, little
  // endian.
  static bool isUnknown(const Head& head) { return std::strncmp(head.vr, "UN", 2) == 0; }

  bool readItems(std::uint64_t& offset, std::uint64_t end, const Form& form, std::uint32_t length,
    DICOMElement& element)
  {
    while (offset < end)
    {
      Head found;
      if (!this->head(offset, form, found))
      {
        return false;
      }
      offset = found.value;
      if (found.tag == EndOfSequence)
      {
        return true;
      }
      if (found.tag != Item || (found.length != Undefined && found.length > end - offset))
      {
        return false;
      }
      element.items.emplace_back();
      const std::uint64_t last = found.length == Undefined ? end : offset + found.length;
      if (!this->readSet(offset, last, form, element.items.back()))
      {
        return false;
      }
    }
    return length != Undefined && offset == end;
  }

  DICOMBytes& Bytes;
  PatientGroup Patient;
};

std::string withoutPadding(const std::string& text)
{
  return text.substr(0, text.find_last_not_of(std::string(" \0", 2)) + 1);
}

// The group of the file itself, which says how all others are written. Old files have none.
bool readMeta(DICOMBytes& bytes, std::uint64_t& offset, DICOMContent& content)
{
  Parser parser(bytes);
  const unsigned char* letters = bytes.at(128, 4);
  offset = letters && std::memcmp(letters, "DICM", 4) == 0 ? 132 : 0;
  Head found;
  bool hasMeta = false;
  while (parser.head(offset, Form(), found) && found.tag >> 16 == 0x0002)
  {
    hasMeta = true;
    if (found.length > bytes.size() - found.value)
    {
      return false;
    }
    if (found.tag == TransferSyntax && found.length <= 64)
    {
      content.transferSyntax.resize(found.length);
      bytes.read(found.value, found.length, content.transferSyntax.data());
      content.transferSyntax = withoutPadding(content.transferSyntax);
    }
    offset = found.value + found.length;
  }
  if (content.transferSyntax.empty() && hasMeta)
  {
    return false; // the group must have it; a guess may read the rest as something else
  }
  if (content.transferSyntax.empty()) // as old files were written
  {
    const bool isExplicit = parser.head(offset, Form(), found);
    content.transferSyntax = isExplicit ? "1.2.840.10008.1.2.1" : Implicit;
  }
  return true;
}
}

DICOMBytes::DICOMBytes(const std::string& path, std::uint64_t mostInflated)
  : Stream(path, std::ios::binary | std::ios::ate)
  , Kept(mostInflated)
{
  this->Size = this->Stream ? static_cast<std::uint64_t>(this->Stream.tellg()) : 0;
}

bool DICOMBytes::read(std::uint64_t offset, std::uint64_t count, void* to)
{
  if (offset > this->Size || count > this->Size - offset)
  {
    return false;
  }
  if (this->IsInflated)
  {
    if (offset + count > this->Inflated.size())
    {
      return false;
    }
    std::memcpy(to, this->Inflated.data() + offset, count);
    return true;
  }
  this->Stream.clear();
  return this->Stream.seekg(static_cast<std::streamoff>(offset)) &&
    this->Stream.read(static_cast<char*>(to), static_cast<std::streamsize>(count));
}

const unsigned char* DICOMBytes::at(std::uint64_t offset, std::size_t count)
{
  const bool isThere =
    offset >= this->WindowOffset && offset + count <= this->WindowOffset + this->Window.size();
  if (!isThere)
  {
    const std::uint64_t end = this->IsInflated ? this->Inflated.size() : this->Size;
    const std::uint64_t rest = offset < end ? end - offset : 0;
    this->Window.resize(std::min(rest, std::max<std::uint64_t>(WindowBytes, count)));
    this->WindowOffset = offset;
    if (this->Window.size() < count ||
      !this->read(offset, this->Window.size(), this->Window.data()))
    {
      this->Window.clear();
      return nullptr;
    }
  }
  return this->Window.data() + (offset - this->WindowOffset);
}

bool DICOMBytes::inflateFrom(std::uint64_t offset)
{
  std::string packed(offset < this->Size ? this->Size - offset : 0, '\0');
  std::string unpacked(offset, '\0');
  if (packed.empty() || !this->read(0, offset, unpacked.data()) ||
    !this->read(offset, packed.size(), packed.data()))
  {
    return false;
  }
  z_stream stream{};
  if (inflateInit2(&stream, -MAX_WBITS) != Z_OK) // without a header
  {
    return false;
  }
  stream.next_in = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_in = static_cast<uInt>(packed.size());
  std::vector<char> piece(1 << 16);
  int result = Z_OK;
  while (result == Z_OK && unpacked.size() < this->Kept)
  {
    stream.next_out = reinterpret_cast<Bytef*>(piece.data());
    stream.avail_out = static_cast<uInt>(piece.size());
    result = inflate(&stream, Z_NO_FLUSH);
    unpacked.append(piece.data(), piece.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  this->Inflated = std::move(unpacked);
  this->IsInflated = true;
  const bool isWhole = result == Z_STREAM_END;
  const bool isCut = result == Z_OK && this->Kept < MostInflated;
  this->Size = isCut ? MostInflated : this->Inflated.size();
  this->Window.clear();
  return isWhole || isCut;
}

bool parseDICOM(DICOMBytes& bytes, DICOMContent& content, PatientGroup patient)
{
  std::uint64_t& offset = content.end;
  if (!readMeta(bytes, offset, content) ||
    (content.transferSyntax == Deflated && !bytes.inflateFrom(offset)))
  {
    return false;
  }
  Form form;
  form.isExplicit = content.transferSyntax != Implicit;
  form.isBig = content.transferSyntax == BigEndian;
  Parser parser(bytes, patient);
  if (!parser.readSet(offset, bytes.size(), form, content.set))
  {
    return false;
  }
  content.repeated = parser.Repeated;
  content.pixelOffset = parser.Pixels.value;
  content.areWords = std::strncmp(parser.Pixels.vr, "OW", 2) == 0;
  content.areReal = content.pixelOffset > 0 && parser.Pixels.tag != PixelData;
  content.isPacked = content.pixelOffset > 0 && parser.Pixels.length == Undefined;
  content.pixelLength = content.isPacked ? 0 : parser.Pixels.length;
  return true;
}

std::vector<std::string> packedFrames(
  DICOMBytes& bytes, const DICOMContent& content, std::size_t frames)
{
  Parser parser(bytes);
  std::vector<std::pair<std::uint64_t, std::uint32_t>> fragments; // offset and length
  Head found;
  std::uint64_t offset = content.pixelOffset;
  while (parser.head(offset, Form(), found) && found.tag == Item &&
    found.length <= bytes.size() - found.value)
  {
    fragments.emplace_back(found.value, found.length);
    offset = found.value + found.length;
  }
  if (fragments.size() < 1 + frames || found.tag != EndOfSequence)
  {
    return {};
  }
  const auto [table, tableLength] = fragments.front();
  fragments.erase(fragments.begin());
  std::set<std::uint64_t> begins; // of frames, where their first item begins
  for (std::uint32_t entry = 0; entry + 4 <= tableLength; entry += 4)
  {
    const unsigned char* stored = bytes.at(table + entry, 4);
    begins.insert(table + tableLength + (stored ? storedNumber<std::uint32_t>(stored, false) : 0));
  }
  const bool isEach = fragments.size() == frames;
  std::vector<std::string> packed;
  for (const auto& [place, length] : fragments)
  {
    if (packed.empty() || isEach || begins.count(place - 8) > 0)
    {
      packed.emplace_back();
    }
    std::string& frame = packed.back();
    frame.resize(frame.size() + length);
    bytes.read(place, length, frame.data() + frame.size() - length);
  }
  return packed.size() == frames ? packed : std::vector<std::string>();
}
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/DICOM/DerivedHeader.h"

#include "Formats/DICOM/DICOMAttributes.h"
#include "Formats/DICOM/DICOMFile.h"
#include "Formats/DICOM/DICOMSegments.h"
#include "Formats/Files/PlainFile.h"

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <random>
#include <set>
#include <system_error>
#include <utility>

namespace brainshift
{
namespace
{
constexpr std::size_t PreambleBytes = 128; // before the letters DICM
constexpr DICOMTag PixelData = 0x7fe00010;
constexpr const char* ExplicitLittleEndian = "1.2.840.10008.1.2.1";
constexpr const char* Implementation = "2.25.232384421460108231880706615814198095366";

void append(std::string& bytes, std::uint32_t number, int count)
{
  for (int i = 0; i < count; ++i)
  {
    bytes += static_cast<char>(number >> 8 * i & 255);
  }
}

void appendTag(std::string& bytes, DICOMTag tag)
{
  append(bytes, tag >> 16, 2);
  append(bytes, tag & 0xffff, 2);
}

// An element of one of the types with a length of 32 bits.
void appendLongHead(std::string& bytes, DICOMTag tag, const char* type, std::size_t length)
{
  appendTag(bytes, tag);
  bytes += type;
  append(bytes, 0, 2);
  append(bytes, static_cast<std::uint32_t>(length), 4);
}

void appendElements(std::string& bytes, const DerivedSet& set)
{
  for (const auto& [tag, element] : set)
  {
    if (element.type == "SQ")
    {
      appendLongHead(bytes, tag, "SQ", element.bytes.size());
    }
    else
    {
      appendTag(bytes, tag);
      bytes += element.type;
      append(bytes, static_cast<std::uint32_t>(element.bytes.size()), 2);
    }
    bytes += element.bytes;
  }
}
// The group of the file itself.
std::string metaOf(const DerivedSet& set)
{
  std::string bytes;
  appendLongHead(bytes, 0x00020001, "OB", 2);
  append(bytes, 0x0100, 2); // version 1
  DerivedSet meta;
  meta[0x00020002] = set.at(0x00080016);
  meta[0x00020003] = set.at(0x00080018);
  setText(meta, 0x00020010, "UI", ExplicitLittleEndian);
  setText(meta, 0x00020012, "UI", Implementation);
  setText(meta, 0x00020013, "SH", "BrainShift");
  appendElements(bytes, meta);
  return bytes;
}

// All bytes of a file, with pixels of a type.
std::string fileWith(const DerivedSet& set, const char* type, const std::string& pixelBytes)
{
  const std::string meta = metaOf(set);
  std::string length;
  append(length, static_cast<std::uint32_t>(meta.size()), 4);
  std::string bytes(PreambleBytes, '\0');
  bytes += "DICM";
  appendElements(bytes, { { 0x00020000, { "UL", length } } });
  bytes += meta;
  appendElements(bytes, set);
  appendLongHead(bytes, PixelData, type, pixelBytes.size());
  return bytes + pixelBytes;
}

namespace fs = std::filesystem;

constexpr const char* CTStorage = "1.2.840.10008.5.1.4.1.1.2";
constexpr const char* MRStorage = "1.2.840.10008.5.1.4.1.1.4";
constexpr const char* PETStorage = "1.2.840.10008.5.1.4.1.1.128";
constexpr const char* SecondaryCapture = "1.2.840.10008.5.1.4.1.1.7";
constexpr int FirstNumber = 1000;      // added to the number of the source's series
constexpr int LastNumber = 2000000000; // VR IS ends at 2147483647

constexpr DICOMTag Modality = 0x00080060;
constexpr DICOMTag SeriesDescription = 0x0008103e;
constexpr DICOMTag SeriesNumber = 0x00200011;
constexpr DICOMTag StudyUID = 0x0020000d;
constexpr DICOMTag FrameOfReferenceUID = 0x00200052;
constexpr DICOMTag ScanningSequence = 0x00180020;
constexpr DICOMTag SequenceVariant = 0x00180021;
constexpr DICOMTag Units = 0x00541001;

// What is kept of the source: patient, study, frame of reference, and how the image was taken. All
// of it is text, which no order of bytes changes. Types are those of the standard's dictionary:
// files with implicit types, or with the type UN, leave them to it.
const std::pair<DICOMTag, const char*> Kept[] = {
  { 0x00080005, "CS" }, // characters
  { 0x00080020, "DA" }, { 0x00080030, "TM" }, { 0x00080050, "SH" }, { 0x00080060, "CS" },
  { 0x00080090, "PN" }, { 0x00081030, "LO" }, // study, modality
  { 0x00100010, "PN" }, { 0x00100020, "LO" }, { 0x00100021, "LO" }, { 0x00100030, "DA" },
  { 0x00100032, "TM" }, { 0x00100040, "CS" }, { 0x00101010, "AS" }, { 0x00101020, "DS" },
  { 0x00101030, "DS" }, // patient
  { 0x00180015, "CS" }, { 0x00180020, "CS" }, { 0x00180021, "CS" }, { 0x00180022, "CS" },
  { 0x00180023, "CS" }, { 0x00180060, "DS" }, { 0x00180080, "DS" }, { 0x00180081, "DS" },
  { 0x00180082, "DS" }, { 0x00180087, "DS" }, { 0x00180091, "IS" },
  { 0x00185100, "CS" }, // how it was taken
  { 0x0020000d, "UI" }, { 0x00200010, "SH" }, { 0x00200052, "UI" }, { 0x00200060, "CS" },
  { 0x00201040, "LO" },                       // study, frame of reference
  { 0x00281050, "DS" }, { 0x00281051, "DS" }, // grey values that are shown
  { Units, "CS" },                            // of PET
};

// What must stand there, empty if nobody knows it (type 2 of the standard).
const std::pair<DICOMTag, const char*> Required[] = {
  { 0x00080020, "DA" },
  { 0x00080030, "TM" },
  { 0x00080050, "SH" },
  { 0x00080090, "PN" },
  { 0x00100010, "PN" },
  { 0x00100020, "LO" },
  { 0x00100030, "DA" },
  { 0x00100040, "CS" },
  { 0x00200010, "SH" },
  { 0x00200012, "IS" },
  { 0x00201040, "LO" },
};

// Multi-frame images become slices of the same kind. A PET image must have a unit.
std::string storageOf(const DICOMDataSet& source)
{
  const std::string modality = textOf(source, Modality);
  const bool isPET = modality == "PT" && !textOf(source, Units).empty();
  return modality == "CT" ? CTStorage
    : modality == "MR"    ? MRStorage
    : isPET               ? PETStorage
                          : SecondaryCapture;
}

// An attribute as the standard names it: (0020,000D).
std::string nameOf(DICOMTag tag)
{
  char name[16];
  std::snprintf(name, sizeof(name), "(%04X,%04X)", tag >> 16, tag & 0xffff);
  return name;
}

// Texts for people may be in any characters; programs read all others, which have ASCII alone.
bool isForPeople(const std::string& type)
{
  return type == "LO" || type == "PN" || type == "SH";
}

// Throws the end of a sentence if a value cannot be kept.
void requireValue(DICOMTag tag, const std::string& type, const DICOMElement& element)
{
  if (!element.items.empty())
  {
    throw Problem(
      "has a sequence as its attribute " + nameOf(tag) + ", which must be a text (" + type + ")");
  }
  if (element.length > MostTextBytes)
  {
    throw Problem("has " + std::to_string(element.length) + " bytes in its attribute " +
      nameOf(tag) + "; DICOM allows at most " + std::to_string(MostTextBytes));
  }
  const std::string text = element.bytes.substr(0, element.bytes.find_last_not_of('\0') + 1);
  const auto wrong = std::find_if(
    text.begin(), text.end(), [](char letter) { return letter < ' ' || letter > '~'; });
  if (!isForPeople(type) && wrong != text.end())
  {
    throw Problem("has the byte " + std::to_string(static_cast<unsigned char>(*wrong)) +
      " in its attribute " + nameOf(tag) + ", which must be text in ASCII (" + type + ")");
  }
}

void requireKept(const DICOMDataSet& set)
{
  for (const auto& [tag, type] : Kept)
  {
    const auto found = set.elements.find(tag);
    if (found != set.elements.end())
    {
      requireValue(tag, type, found->second);
    }
  }
  for (const DICOMTag tag : { StudyUID, Modality })
  {
    if (textOf(set, tag).empty())
    {
      throw Problem(
        std::string("has no ") + (tag == StudyUID ? "study " : "modality ") + nameOf(tag));
    }
  }
}

// Structures, reports and presentations are DICOM files of the patient without an image.
void requireScan(const DICOMContent& content)
{
  if (wholeOf(content.set, 0x00280010, 0.0) <= 0.0 ||
    wholeOf(content.set, 0x00280011, 0.0) <= 0.0 || content.pixelOffset == 0)
  {
    throw Problem("is no DICOM image: it lacks Rows, Columns or pixels");
  }
  if (segmentKindOf(content.set) != SegmentKind::None)
  {
    throw Problem("is no DICOM image of a scanner: it is a segmentation");
  }
}

// Throws the end of a sentence, after the name of the file, if it cannot be taken.
void readImage(const std::string& fileName, DICOMDataSet& source)
{
  requirePlainFile(fileName);
  if (!isDICOMFile(fileName))
  {
    throw Problem("is no DICOM image");
  }
  DICOMBytes bytes(fileName, DICOMBytes::MostOfHeader);
  DICOMContent content;
  if (!parseDICOM(bytes, content, PatientGroup::Kept))
  {
    throw Problem("is damaged at byte " + std::to_string(content.end) + " of " +
      std::to_string(bytes.size()) + ": no attribute is there, or its length is wrong");
  }
  requireKept(content.set);
  requireScan(content);
  source = std::move(content.set);
}

void setNow(DerivedSet& set)
{
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
#ifdef _WIN32
  localtime_s(&parts, &now);
#else
  localtime_r(&now, &parts);
#endif
  char date[16];
  char time[16];
  std::strftime(date, sizeof(date), "%Y%m%d", &parts);
  std::strftime(time, sizeof(time), "%H%M%S", &parts);
  for (const DICOMTag tag : { 0x00080012, 0x00080021, 0x00080023 }) // instance, series, content
  {
    setText(set, tag, "DA", date);
    setText(set, tag == 0x00080012 ? 0x00080013 : tag + 16, "TM", time);
  }
}

// How the image was taken, its grey values and their unit.
bool isOfScanner(DICOMTag tag)
{
  return tag >> 16 == 0x0018 || tag >> 16 == 0x0028 || tag == Units;
}

template <typename Choice>
void keep(const DICOMDataSet& source, DerivedSet& set, const Choice& isMeant)
{
  for (const auto& [tag, type] : Kept)
  {
    const auto found = source.elements.find(tag);
    if (found != source.elements.end() && isMeant(tag))
    {
      setText(set, tag, type, found->second.bytes);
    }
  }
}

// What a slice of MR must say: enhanced files have it in the groups that all frames share.
void setTiming(const DICOMDataSet& source, DerivedSet& set)
{
  const auto groupOf = [&source](DICOMTag group) {
    const auto& shared = itemsOf(source, 0x52009229);
    const auto& items = itemsOf(shared.empty() ? source : shared.front(), group);
    return items.empty() ? DICOMDataSet() : items.front();
  };
  const DICOMDataSet timing = groupOf(0x00189112);
  const double echoMs = doubleOf(groupOf(0x00189114), 0x00189082, 0.0);
  const auto fill = [&set](DICOMTag tag, const char* type, const std::string& text) {
    if (set.count(tag) == 0)
    {
      setText(set, tag, type, text);
    }
  };
  fill(0x00180080, "DS", textOf(timing, 0x00180080));              // RepetitionTime
  fill(0x00180081, "DS", echoMs > 0.0 ? decimalText(echoMs) : ""); // EchoTime
  fill(0x00180091, "IS", textOf(timing, 0x00180091));              // EchoTrainLength
}

void setKind(const DICOMDataSet& source, DerivedSet& set)
{
  const std::string modality = textOf(source, Modality);
  const std::string storage = storageOf(source);
  setText(set, 0x00080016, "UI", storage);
  setText(set, 0x00080008, "CS", "DERIVED\\SECONDARY\\OTHER");
  setText(set, 0x00080070, "LO", "BrainShift");
  setText(set, 0x00082111, "ST", std::string("Volume of BrainShift: ") + NotForClinicalUse);
  if (storage != PETStorage)
  {
    set.erase(Units);
  }
  if (storage == SecondaryCapture)
  {
    setText(set, 0x00080064, "CS", "WSD"); // made at a workstation
  }
  if (storage == MRStorage)
  {
    setTiming(source, set);
  }
  if (modality == "MR" && textOf(source, ScanningSequence).empty())
  {
    setText(set, ScanningSequence, "CS", "RM"); // research mode
    setText(set, SequenceVariant, "CS", "NONE");
  }
}

void setPixelFormat(const DerivedPixels& pixels, DerivedSet& set)
{
  const Grid& grid = pixels.grid;
  setWhole(set, 0x00280002, 1); // samples of a pixel
  setText(set, 0x00280004, "CS", pixels.smallIsBright ? "MONOCHROME1" : "MONOCHROME2");
  setWhole(set, 0x00280010, grid.dimensions.y);
  setWhole(set, 0x00280011, grid.dimensions.x);
  setText(set, 0x00280030, "DS", decimalText(grid.spacing.y) + "\\" + decimalText(grid.spacing.x));
  setWhole(set, 0x00280100, 16);
  setWhole(set, 0x00280101, 16);
  setWhole(set, 0x00280102, 15);
  setWhole(set, 0x00280103, pixels.isSigned ? 1 : 0);
  setText(set, 0x00280301, "CS", "NO"); // nothing is burned in
  setText(set, 0x00281052, "DS", decimalText(pixels.rescaling.intercept));
  setText(set, 0x00281053, "DS", decimalText(pixels.rescaling.slope));
  setText(set, 0x00180050, "DS", decimalText(grid.spacing.z));
  setText(set, 0x00180088, "DS", decimalText(grid.spacing.z));
  std::string orientation;
  for (int i = 0; i < 6; ++i)
  {
    orientation += (i > 0 ? "\\" : "") + decimalText(grid.direction[i / 3][i % 3]);
  }
  setText(set, 0x00200037, "DS", orientation);
}
}

void setText(DerivedSet& set, DICOMTag tag, const std::string& type, const std::string& text)
{
  std::string padded = text;
  if (padded.size() % 2 == 1)
  {
    padded += type == "UI" ? '\0' : ' ';
  }
  set[tag] = { type, padded };
}

void setWhole(DerivedSet& set, DICOMTag tag, int number)
{
  setWholes(set, tag, "US", { static_cast<std::uint32_t>(number) });
}

void setWholes(
  DerivedSet& set, DICOMTag tag, const std::string& type, const std::vector<std::uint32_t>& all)
{
  std::string bytes;
  for (const std::uint32_t number : all)
  {
    if (type == "AT")
    {
      appendTag(bytes, number);
    }
    else
    {
      append(bytes, number, type == "UL" ? 4 : 2);
    }
  }
  set[tag] = { type, bytes };
}

void setSequence(DerivedSet& set, DICOMTag tag, const std::vector<DerivedSet>& items)
{
  std::string bytes;
  for (const DerivedSet& item : items)
  {
    std::string elements;
    appendElements(elements, item);
    appendTag(bytes, 0xfffee000);
    append(bytes, static_cast<std::uint32_t>(elements.size()), 4);
    bytes += elements;
  }
  set[tag] = { "SQ", bytes };
}

std::string newUID()
{
  std::random_device random;
  std::array<std::uint32_t, 4> words{}; // of a number of 128 bits, the highest first
  std::generate(words.begin(), words.end(), std::ref(random));
  words[1] = (words[1] & 0xffff0fff) | 0x4000; // the version: random
  words[2] = (words[2] & 0x3fffffff) | 0x80000000;
  std::string digits;
  while (std::any_of(words.begin(), words.end(), [](std::uint32_t word) { return word > 0; }))
  {
    std::uint64_t rest = 0;
    for (std::uint32_t& word : words) // divides by 10
    {
      rest = rest << 32 | word;
      word = static_cast<std::uint32_t>(rest / 10);
      rest %= 10;
    }
    digits += static_cast<char>('0' + rest);
  }
  std::reverse(digits.begin(), digits.end());
  return "2.25." + digits;
}

std::string fileOf(const DerivedSet& set, const std::string& pixelBytes)
{
  return fileWith(set, "OB", pixelBytes);
}

std::string fileOf(const DerivedSet& set, const std::vector<std::uint16_t>& pixels)
{
  std::string bytes;
  bytes.reserve(2 * pixels.size());
  for (const std::uint16_t pixel : pixels)
  {
    append(bytes, pixel, 2);
  }
  return fileWith(set, "OW", bytes);
}

void readLike(const std::string& like, DICOMDataSet& source)
{
  if (like.empty())
  {
    throw Problem(
      "Like is missing: a DICOM file of the patient's scan, whose patient and study the "
      "series takes");
  }
  std::error_code error;
  if (!fs::is_directory(like, error))
  {
    const std::string problem = problemOf([&] { readImage(like, source); });
    throwIfAny(problem.empty() ? problem
                               : "Like is " + like + ", which " + problem +
          "; choose another image of the patient's scan");
    return;
  }
  std::set<std::string> names;
  for (fs::directory_iterator next(like, error), end; next != end && !error; next.increment(error))
  {
    names.insert(next->path().string());
  }
  const bool isFound = std::any_of(names.begin(), names.end(), [&source](const std::string& name) {
    return problemOf([&] { readImage(name, source); }).empty();
  });
  if (!isFound)
  {
    throw Problem("Like is " + like + ", a folder with " + std::to_string(names.size()) +
      " entries and no DICOM image that can be read and has a study and a modality; choose an "
      "image of the patient's scan");
  }
}

void setNewSeries(const DICOMDataSet& source, DerivedSet& set)
{
  // What the user must see comes first: stations cut long descriptions.
  std::string description = NotForClinicalUse;
  const std::string old = textOf(source, SeriesDescription);
  if (!old.empty() && description.size() + 2 + old.size() <= LongestText)
  {
    description += ": " + old;
  }
  setText(set, SeriesDescription, "LO", description);
  const double number = decimalOf(source, SeriesNumber, 0.0);
  const bool isNumber = number > 0.0 && number <= LastNumber;
  setText(set, SeriesNumber, "IS",
    std::to_string(FirstNumber + (isNumber ? static_cast<int>(number) : 0)));
  setText(set, 0x0020000e, "UI", newUID());
  if (textOf(source, FrameOfReferenceUID).empty())
  {
    setText(set, FrameOfReferenceUID, "UI", newUID());
  }
}

DerivedSet studyHeader(const DICOMDataSet& source)
{
  DerivedSet set;
  for (const auto& [tag, type] : Required)
  {
    setText(set, tag, type, "");
  }
  keep(source, set, [](DICOMTag tag) { return !isOfScanner(tag); });
  setNow(set);
  return set;
}

DerivedSet sharedHeader(const DICOMDataSet& source, const DerivedPixels& pixels)
{
  DerivedSet set = studyHeader(source);
  keep(source, set, isOfScanner);
  setKind(source, set);
  setNewSeries(source, set);
  setPixelFormat(pixels, set);
  return set;
}

void setSlice(const DerivedPixels& pixels, int slice, DerivedSet& header)
{
  const glm::dvec3 place = pixels.grid.worldFromGrid({ 0.0, 0.0, static_cast<double>(slice) });
  setText(header, 0x00080018, "UI", newUID());
  setText(header, 0x00200013, "IS", std::to_string(slice + 1));
  setText(header, 0x00200032, "DS",
    decimalText(place.x) + "\\" + decimalText(place.y) + "\\" + decimalText(place.z));
}
}

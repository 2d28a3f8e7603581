// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/DICOM/DerivedHeader.h"

#include "Formats/Files/PlainFile.h"

#include <gdcmDataSetHelper.h>
#include <gdcmReader.h>
#include <gdcmUIDGenerator.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <set>
#include <system_error>
#include <vector>

namespace brainshift
{
namespace
{
namespace fs = std::filesystem;

constexpr const char* CTStorage = "1.2.840.10008.5.1.4.1.1.2";
constexpr const char* MRStorage = "1.2.840.10008.5.1.4.1.1.4";
constexpr const char* PETStorage = "1.2.840.10008.5.1.4.1.1.128";
constexpr const char* SecondaryCapture = "1.2.840.10008.5.1.4.1.1.7";
constexpr std::size_t LongestText = 64; // of VR LO
constexpr int FirstNumber = 1000;       // added to the number of the source's series

const gdcm::Tag Modality(0x0008, 0x0060);
const gdcm::Tag SeriesDescription(0x0008, 0x103e);
const gdcm::Tag SeriesNumber(0x0020, 0x0011);
const gdcm::Tag StudyUID(0x0020, 0x000d);
const gdcm::Tag FrameOfReferenceUID(0x0020, 0x0052);
const gdcm::Tag ScanningSequence(0x0018, 0x0020);
const gdcm::Tag SequenceVariant(0x0018, 0x0021);
const gdcm::Tag Pixels(0x7fe0, 0x0010);

// What is kept of the source: patient, study, frame of reference, and how the image was taken.
const gdcm::Tag Kept[] = {
  { 0x0008, 0x0005 }, // characters
  { 0x0008, 0x0020 }, { 0x0008, 0x0030 }, { 0x0008, 0x0050 }, { 0x0008, 0x0060 },
  { 0x0008, 0x0090 }, { 0x0008, 0x1030 }, // study, modality
  { 0x0010, 0x0010 }, { 0x0010, 0x0020 }, { 0x0010, 0x0021 }, { 0x0010, 0x0030 },
  { 0x0010, 0x0032 }, { 0x0010, 0x0040 }, { 0x0010, 0x1010 }, { 0x0010, 0x1020 },
  { 0x0010, 0x1030 }, // patient
  { 0x0018, 0x0015 }, { 0x0018, 0x0020 }, { 0x0018, 0x0021 }, { 0x0018, 0x0022 },
  { 0x0018, 0x0023 }, { 0x0018, 0x0060 }, { 0x0018, 0x0080 }, { 0x0018, 0x0081 },
  { 0x0018, 0x0082 }, { 0x0018, 0x0087 }, { 0x0018, 0x0091 }, { 0x0018, 0x5100 },
  { 0x0020, 0x000d }, { 0x0020, 0x0010 }, { 0x0020, 0x0052 }, { 0x0020, 0x0060 },
  { 0x0020, 0x1040 },                     // study, frame of reference
  { 0x0028, 0x1050 }, { 0x0028, 0x1051 }, // grey values that are shown
};

// What must stand there, empty if nobody knows it (type 2 of the standard).
const std::pair<gdcm::Tag, gdcm::VR::VRType> Required[] = {
  { { 0x0008, 0x0020 }, gdcm::VR::DA },
  { { 0x0008, 0x0030 }, gdcm::VR::TM },
  { { 0x0008, 0x0050 }, gdcm::VR::SH },
  { { 0x0008, 0x0090 }, gdcm::VR::PN },
  { { 0x0010, 0x0010 }, gdcm::VR::PN },
  { { 0x0010, 0x0020 }, gdcm::VR::LO },
  { { 0x0010, 0x0030 }, gdcm::VR::DA },
  { { 0x0010, 0x0040 }, gdcm::VR::CS },
  { { 0x0020, 0x0010 }, gdcm::VR::SH },
  { { 0x0020, 0x0012 }, gdcm::VR::IS },
  { { 0x0020, 0x1040 }, gdcm::VR::LO },
};

std::string textOf(const gdcm::DataSet& set, const gdcm::Tag& tag)
{
  const gdcm::ByteValue* bytes =
    set.FindDataElement(tag) ? set.GetDataElement(tag).GetByteValue() : nullptr;
  std::string text =
    bytes && bytes->GetLength() > 0 ? std::string(bytes->GetPointer(), bytes->GetLength()) : "";
  text.erase(std::min(text.find_last_not_of(std::string(" \0", 2)) + 1, text.size()));
  return text;
}

void setText(
  gdcm::DataSet& set, const gdcm::Tag& tag, gdcm::VR::VRType type, const std::string& text)
{
  std::string padded = text;
  if (padded.size() % 2 == 1)
  {
    padded += type == gdcm::VR::UI ? '\0' : ' ';
  }
  gdcm::DataElement element(tag);
  element.SetVR(type);
  element.SetByteValue(padded.data(), gdcm::VL(static_cast<std::uint32_t>(padded.size())));
  set.Replace(element);
}

void setWhole(gdcm::DataSet& set, const gdcm::Tag& tag, int number)
{
  const auto bits = static_cast<std::uint16_t>(number);
  const char bytes[2] = { static_cast<char>(bits & 255), static_cast<char>(bits >> 8) };
  gdcm::DataElement element(tag);
  element.SetVR(gdcm::VR::US);
  element.SetByteValue(bytes, 2);
  set.Replace(element);
}

std::string newUID()
{
  gdcm::UIDGenerator generator;
  return generator.Generate();
}

// Multi-frame images become slices of the same kind.
std::string storageOf(const std::string& modality)
{
  return modality == "CT" ? CTStorage
    : modality == "MR"    ? MRStorage
    : modality == "PT"    ? PETStorage
                          : SecondaryCapture;
}

bool readImage(const std::string& fileName, gdcm::DataSet& source)
{
  gdcm::Reader reader;
  reader.SetFileName(fileName.c_str());
  if (!plainFileProblem(fileName).empty() || !reader.ReadUpToTag(Pixels))
  {
    return false;
  }
  source.Clear();
  const gdcm::DataSet& read = reader.GetFile().GetDataSet();
  for (const gdcm::DataElement& element : read.GetDES())
  {
    gdcm::DataElement typed = element; // implicit syntaxes leave types to the dictionary
    typed.SetVR(gdcm::DataSetHelper::ComputeVR(reader.GetFile(), read, element.GetTag()));
    source.Insert(typed);
  }
  return !textOf(source, StudyUID).empty() && !textOf(source, Modality).empty();
}

void setNow(gdcm::DataSet& set)
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
  for (const std::uint16_t element : { 0x0012, 0x0021, 0x0023 }) // instance, series, content
  {
    setText(set, { 0x0008, element }, gdcm::VR::DA, date);
    setText(set, { 0x0008, static_cast<std::uint16_t>(element == 0x0012 ? 0x0013 : element + 16) },
      gdcm::VR::TM, time);
  }
}

void setSeries(const gdcm::DataSet& source, gdcm::DataSet& set)
{
  const std::string modality = textOf(source, Modality);
  setText(set, { 0x0008, 0x0016 }, gdcm::VR::UI, storageOf(modality));
  setText(set, { 0x0008, 0x0008 }, gdcm::VR::CS, "DERIVED\\SECONDARY\\OTHER");
  setText(set, { 0x0008, 0x0070 }, gdcm::VR::LO, "BrainShift");
  setText(set, { 0x0008, 0x2111 }, gdcm::VR::ST,
    std::string("Volume of BrainShift: ") + NotForClinicalUse);
  if (storageOf(modality) == SecondaryCapture)
  {
    setText(set, { 0x0008, 0x0064 }, gdcm::VR::CS, "WSD"); // made at a workstation
  }
  if (modality == "MR" && textOf(source, ScanningSequence).empty())
  {
    setText(set, ScanningSequence, gdcm::VR::CS, "RM"); // research mode
    setText(set, SequenceVariant, gdcm::VR::CS, "NONE");
  }
  // What the user must see comes first: stations cut long descriptions.
  std::string description = NotForClinicalUse;
  const std::string old = textOf(source, SeriesDescription);
  if (!old.empty() && description.size() + 2 + old.size() <= LongestText)
  {
    description += ": " + old;
  }
  setText(set, SeriesDescription, gdcm::VR::LO, description);
  const int number = std::atoi(textOf(source, SeriesNumber).c_str());
  setText(set, SeriesNumber, gdcm::VR::IS, std::to_string(FirstNumber + std::max(number, 0)));
  setText(set, { 0x0020, 0x000e }, gdcm::VR::UI, newUID());
  if (textOf(set, FrameOfReferenceUID).empty())
  {
    setText(set, FrameOfReferenceUID, gdcm::VR::UI, newUID());
  }
}

void setPixelFormat(const DerivedPixels& pixels, gdcm::DataSet& set)
{
  const Grid& grid = pixels.grid;
  setWhole(set, { 0x0028, 0x0002 }, 1); // samples of a pixel
  setText(set, { 0x0028, 0x0004 }, gdcm::VR::CS, "MONOCHROME2");
  setWhole(set, { 0x0028, 0x0010 }, grid.dimensions.y);
  setWhole(set, { 0x0028, 0x0011 }, grid.dimensions.x);
  setText(set, { 0x0028, 0x0030 }, gdcm::VR::DS,
    decimalText(grid.spacing.y) + "\\" + decimalText(grid.spacing.x));
  setWhole(set, { 0x0028, 0x0100 }, 16);
  setWhole(set, { 0x0028, 0x0101 }, 16);
  setWhole(set, { 0x0028, 0x0102 }, 15);
  setWhole(set, { 0x0028, 0x0103 }, pixels.isSigned ? 1 : 0);
  setText(set, { 0x0028, 0x0301 }, gdcm::VR::CS, "NO"); // nothing is burned in
  setText(set, { 0x0028, 0x1052 }, gdcm::VR::DS, decimalText(pixels.rescaling.intercept));
  setText(set, { 0x0028, 0x1053 }, gdcm::VR::DS, decimalText(pixels.rescaling.slope));
  setText(set, { 0x0018, 0x0050 }, gdcm::VR::DS, decimalText(grid.spacing.z));
  setText(set, { 0x0018, 0x0088 }, gdcm::VR::DS, decimalText(grid.spacing.z));
  std::string orientation;
  for (int i = 0; i < 6; ++i)
  {
    orientation += (i > 0 ? "\\" : "") + decimalText(grid.direction[i / 3][i % 3]);
  }
  setText(set, { 0x0020, 0x0037 }, gdcm::VR::DS, orientation);
}
}

std::string readLike(const std::string& like, gdcm::DataSet& source)
{
  if (like.empty())
  {
    return "Like is missing: a DICOM file of the patient's scan, whose patient and study the "
           "series takes";
  }
  std::error_code error;
  std::set<std::string> names{ like };
  if (fs::is_directory(like, error))
  {
    names.clear();
    for (fs::directory_iterator next(like, error), end; next != end && !error;
      next.increment(error))
    {
      names.insert(next->path().string());
    }
  }
  for (const std::string& name : names)
  {
    if (readImage(name, source))
    {
      return {};
    }
  }
  return "Like is " + like + ", where no DICOM image with a study and a modality can be read";
}

gdcm::DataSet sharedHeader(const gdcm::DataSet& source, const DerivedPixels& pixels)
{
  gdcm::DataSet set;
  for (const gdcm::Tag& tag : Kept)
  {
    if (source.FindDataElement(tag))
    {
      set.Replace(source.GetDataElement(tag));
    }
  }
  for (const auto& [tag, type] : Required)
  {
    if (!set.FindDataElement(tag))
    {
      setText(set, tag, type, "");
    }
  }
  setNow(set);
  setSeries(source, set);
  setPixelFormat(pixels, set);
  return set;
}

void setSlice(const DerivedPixels& pixels, int slice, gdcm::DataSet& header)
{
  const glm::dvec3 place = pixels.grid.worldFromGrid({ 0.0, 0.0, static_cast<double>(slice) });
  setText(header, { 0x0008, 0x0018 }, gdcm::VR::UI, newUID());
  setText(header, { 0x0020, 0x0013 }, gdcm::VR::IS, std::to_string(slice + 1));
  setText(header, { 0x0020, 0x0032 }, gdcm::VR::DS,
    decimalText(place.x) + "\\" + decimalText(place.y) + "\\" + decimalText(place.z));
}
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/NIFTI/NIFTIVolume.h"

#include "Common/Bytes.h"
#include "Common/Numbers.h"
#include "Formats/Files/PackedBytes.h"
#include "Formats/Files/Text.h"
#include "Formats/NIFTI/NIFTIHeader.h"
#include "Formats/Volumes/OutgoingVolume.h"

#include "vtkCommand.h"
#include "vtkExecutive.h"
#include "vtkImageData.h"
#include "vtkNIFTIImageHeader.h"

#include <array>
#include <cmath>
#include <limits>

namespace brainshift
{
namespace
{
constexpr std::int32_t WorkbenchCode = 30; // NIFTI_ECODE_CARET
constexpr std::int32_t LongestExtension = 1 << 24;
constexpr int MostExtensions = 100;
constexpr std::size_t MostLabels = 65536;
constexpr int FirstOfFSL = 2006; // intents of fields and of their coefficients
constexpr int LastOfFSL = 2018;

// Some bytes of a file that may be packed. False if they are not there.
bool bytesAt(
  const std::string& fileName, std::uint64_t place, std::size_t count, std::string& bytes)
{
  const bool isPacked = beginsLikeGzip(fileName);
  const StoredBytes from{ fileName, isPacked ? 0 : place, isPacked, isPacked ? place : 0 };
  return problemOf([&] {
    requireBytes(from, static_cast<double>(count));
    bytes.assign(count, '\0');
    readBytes(from, bytes.data(), count, [](double) { return true; });
  }).empty();
}

// What follows the header of a file.
struct Extensions
{
  std::string text;      // of the first one of Connectome Workbench; empty if there is none
  std::uint64_t end = 0; // byte after the last one
};

// Those that begin before the voxels.
Extensions extensionsOf(const std::string& fileName, std::uint64_t voxels)
{
  Extensions found;
  std::string bytes;
  if (!bytesAt(fileName, 0, 4, bytes))
  {
    return found;
  }
  const auto isHeader = [](std::int32_t size) { return size == 348 || size == 540; };
  const bool isBigEndian = !isHeader(storedNumber<std::int32_t>(bytes.data(), false));
  const std::int32_t headerBytes = storedNumber<std::int32_t>(bytes.data(), isBigEndian);
  if (!isHeader(headerBytes) ||
    !bytesAt(fileName, static_cast<std::uint64_t>(headerBytes), 4, bytes) || bytes[0] == 0)
  {
    return found;
  }
  std::uint64_t place = static_cast<std::uint64_t>(headerBytes) + 4;
  for (int i = 0; i < MostExtensions && place < voxels && bytesAt(fileName, place, 8, bytes); ++i)
  {
    const std::int32_t size = storedNumber<std::int32_t>(bytes.data(), isBigEndian);
    if (size < 16 || size > LongestExtension || size % 16 != 0)
    {
      return found; // voxels, or damage
    }
    const bool isLabels = found.text.empty() &&
      storedNumber<std::int32_t>(bytes.data() + 4, isBigEndian) == WorkbenchCode;
    const bool isWhole = bytesAt(fileName, place + 8, static_cast<std::size_t>(size) - 8, bytes);
    found.text = isLabels && isWhole ? bytes : found.text;
    place += static_cast<std::uint64_t>(size);
    found.end = place;
  }
  return found;
}

// The number of an attribute; NaN if the element has none.
double attribute(const std::string& element, const std::string& name)
{
  const std::string key = " " + name + "=\"";
  const std::size_t begin = element.find(key);
  const std::size_t end =
    begin == std::string::npos ? begin : element.find('"', begin + key.size());
  const std::vector<double> numbers = end == std::string::npos
    ? std::vector<double>()
    : numbersIn(element.substr(begin + key.size(), end - begin - key.size()));
  return numbers.size() == 1 ? numbers[0] : std::nan("");
}

// What stands between the tags, with or without CDATA.
std::string contentOf(std::string text)
{
  const std::string open = "<![CDATA[";
  const std::size_t begin = text.find(open);
  if (begin != std::string::npos)
  {
    text.erase(0, begin + open.size());
    text.erase(std::min(text.find("]]>"), text.size()));
  }
  return text;
}

// The labels in an extension of Connectome Workbench; none if the text is empty. It stores them as
// XML in an extension with code 30:
// <Label Key="1" Red="1" Green="0.5" Blue="0" Alpha="1"><![CDATA[name]]></Label>
std::vector<Label> niftiLabels(const std::string& text)
{
  const std::string close = "</Label>";
  std::vector<Label> labels;
  for (std::size_t place = text.find("<Label "); place != std::string::npos;
    place = text.find("<Label ", place + 1))
  {
    const std::size_t middle = text.find('>', place);
    const std::size_t end = text.find(close, place);
    if (middle == std::string::npos || end == std::string::npos || middle > end ||
      labels.size() == MostLabels)
    {
      break;
    }
    const std::string element = text.substr(place, middle - place);
    const double key = attribute(element, "Key");
    if (!isWhole(key, std::numeric_limits<int>::min(), std::numeric_limits<int>::max()))
    {
      continue;
    }
    Label label;
    label.value = static_cast<int>(key);
    label.name = contentOf(text.substr(middle + 1, end - middle - 1));
    const std::array<const char*, 3> names{ "Red", "Green", "Blue" };
    for (std::size_t i = 0; i < names.size(); ++i)
    {
      const double share = attribute(element, names[i]);
      label.color[i] = share >= 0.0
        ? static_cast<unsigned char>(std::lround(255.0 * std::min(share, 1.0)))
        : label.color[i];
    }
    labels.push_back(label);
  }
  return labels;
}

NIFTIPlacement placementOf(vtkNIFTIImageHeader* header)
{
  NIFTIPlacement placement;
  for (int axis = 0; axis < 3; ++axis)
  {
    placement.dimensions[axis] = static_cast<int>(header->GetDim(axis + 1));
  }
  placement.sformCode = header->GetSFormCode();
  placement.qformCode = header->GetQFormCode();
  const double* const rows[3] = { header->GetSRowX(), header->GetSRowY(), header->GetSRowZ() };
  for (int row = 0; row < 3; ++row)
  {
    placement.sformRows[row] = glm::dvec4(rows[row][0], rows[row][1], rows[row][2], rows[row][3]);
  }
  placement.quaternion =
    glm::dvec3(header->GetQuaternB(), header->GetQuaternC(), header->GetQuaternD());
  placement.qformOffset =
    glm::dvec3(header->GetQOffsetX(), header->GetQOffsetY(), header->GetQOffsetZ());
  placement.pixelSize =
    glm::dvec3(header->GetPixDim(1), header->GetPixDim(2), header->GetPixDim(3));
  placement.qfac = header->GetPixDim(0);
  placement.mmPerUnit = mmPerNIFTIUnit(header->GetXYZTUnits()).value_or(1.0);
  return placement;
}

// vtkNIFTIImageReader reverses the slices of left-handed files.
glm::dmat4 voxelFromReversedSlices(int slices)
{
  glm::dmat4 voxelFromReversed(1.0);
  voxelFromReversed[2][2] = -1.0;
  voxelFromReversed[3][2] = slices - 1;
  return voxelFromReversed;
}

Template templateOf(const NIFTIPlacement& placement)
{
  const int code = sformCounts(placement) ? placement.sformCode : placement.qformCode;
  const bool isTemplate =
    code >= static_cast<int>(Template::Talairach) && code <= static_cast<int>(Template::Other);
  return isTemplate ? static_cast<Template>(code) : Template::None;
}

NIFTITiming timingOf(vtkNIFTIImageHeader* header)
{
  const vtkTypeInt64 count = header->GetDim(0) >= 4 ? header->GetDim(4) : 1;
  return { static_cast<std::size_t>(std::max<vtkTypeInt64>(count, 0)), header->GetPixDim(4),
    header->GetTOffset(), header->GetXYZTUnits() };
}

// Keeps the first error of an object that is not to speak to the user itself, without the name of
// its source file.
void keepError(vtkObject*, unsigned long event, void* clientData, void* callData)
{
  std::string& kept = *static_cast<std::string*>(clientData);
  if (event != vtkCommand::ErrorEvent || !kept.empty())
  {
    return;
  }
  kept = static_cast<const char*>(callData);
  const std::size_t textBegin = kept.find("): ");
  kept = textBegin == std::string::npos ? kept : kept.substr(textBegin + 3);
  kept.erase(kept.find_last_not_of(" .\n") + 1);
}

Rescaling rescalingOf(vtkNIFTIImageHeader* header, std::vector<std::string>& warnings)
{
  const int type = header->GetDataType();
  const bool isColour =
    type == vtkNIFTIImageHeader::TypeRGB24 || type == vtkNIFTIImageHeader::TypeRGBA32;
  const double slope = header->GetSclSlope();
  if (std::isinf(slope))
  {
    throw Problem(joined("has the scl_slope ", slope, "; it must be finite"));
  }
  const bool isUsed = !std::isnan(slope) && slope != 0.0;
  if (isUsed && !isColour && !std::isfinite(header->GetSclInter()))
  {
    throw Problem(joined("has the scl_inter ", header->GetSclInter(), "; it must be finite"));
  }
  if (isUsed && isColour && slope != 1.0)
  {
    warnings.push_back(joined("has the scl_slope ", slope, ", which does not count for colours"));
  }
  if (!isUsed && std::isfinite(header->GetSclInter()) && header->GetSclInter() != 0.0)
  {
    warnings.push_back(
      joined("has the scl_inter ", header->GetSclInter(), " but no scl_slope; neither counts"));
  }
  return isUsed && !isColour ? Rescaling{ slope, header->GetSclInter() } : Rescaling();
}

// Numbers that say the same twice, or nothing that NIfTI knows.
void noteCodes(vtkNIFTIImageHeader* header, int bytesOfVoxel, std::vector<std::string>& warnings)
{
  const int bits = header->GetBitPix();
  if (bits != 0 && bits != 8 * bytesOfVoxel)
  {
    warnings.push_back(joined("has the bitpix ", bits, " for the datatype ", header->GetDataType(),
      " of ", 8 * bytesOfVoxel, " bits; the datatype counts"));
  }
  const int units = header->GetXYZTUnits();
  if (!mmPerNIFTIUnit(units))
  {
    warnings.push_back(joined("has the xyzt_units ", units, ", whose unit of length ", units & 7,
      " NIfTI does not know; it counts as mm"));
  }
  if ((units & ~0x3f) != 0)
  {
    warnings.push_back(joined("has the xyzt_units ", units,
      ", which is more than NIfTI knows; only its unit of length and time count"));
  }
}
}

namespace
{
// A number of the table that has two names.
void noteLabels(VolumeHeader& header)
{
  std::map<int, std::string> names;
  for (const Label& label : header.labels)
  {
    if (names.insert({ label.value, label.name }).first->second != label.name)
    {
      header.warnings.push_back(
        twice("label " + std::to_string(label.value)) + ", with different names");
      return;
    }
  }
}

// Vectors, tensors and fields have their components in dim[5].
void noteVectors(vtkNIFTIImageHeader* header, std::vector<std::string>& warnings)
{
  const int intent = header->GetIntentCode();
  const bool isOfVectors = intent == vtkNIFTIImageHeader::IntentGenMatrix ||
    intent == vtkNIFTIImageHeader::IntentSymMatrix ||
    intent == vtkNIFTIImageHeader::IntentDispVect || intent == vtkNIFTIImageHeader::IntentVector ||
    (intent >= FirstOfFSL && intent <= LastOfFSL);
  const bool isOfVolumes = header->GetDim(0) >= 4 && header->GetDim(4) > 1 &&
    (header->GetDim(0) < 5 || header->GetDim(5) <= 1);
  if (isOfVectors && isOfVolumes)
  {
    warnings.push_back(
      joined("has the intent ", intent, " of several numbers at a voxel, but ", header->GetDim(4),
        " entries in dim[4], which count as times; NIfTI has components in dim[5]"));
  }
}
}

NIFTIVolume::NIFTIVolume()
{
  this->Voxels->TimeAsVectorOn();
  this->KeepError->SetCallback(keepError);
  this->KeepError->SetClientData(&this->Error);
  for (vtkObject* speaker : { static_cast<vtkObject*>(this->Voxels),
         static_cast<vtkObject*>(this->Voxels->GetExecutive()) })
  {
    speaker->AddObserver(vtkCommand::ErrorEvent, this->KeepError);
    speaker->AddObserver(vtkCommand::WarningEvent, this->KeepError); // of flips, undone here
  }
}

void NIFTIVolume::readHeader(const std::string& fileName, VolumeHeader& header)
{
  requireNIFTIFile(fileName);
  this->IsPacked = beginsLikeGzip(fileName);
  this->Error.clear();
  this->Voxels->SetFileName(fileName.c_str());
  this->Voxels->Modified(); // the file may have changed under its name
  this->Voxels->UpdateInformation();
  if (!this->Error.empty())
  {
    throw Problem("cannot be read: " + this->Error);
  }
  vtkNIFTIImageHeader* stored = this->Voxels->GetNIFTIHeader();
  header.rescaling = rescalingOf(stored, header.warnings);
  header.times = timesOf(timingOf(stored), header.warnings);
  this->Volumes = static_cast<int>(header.times.size());
  header.storedType = this->Voxels->GetDataScalarType();
  header.components = this->Voxels->GetNumberOfScalarComponents() / this->Volumes;
  noteCodes(stored, bytesOfNIFTIVoxel(stored->GetDataType()), header.warnings);
  noteVectors(stored, header.warnings);
  header.worldFromVoxel = worldFromVoxel(placementOf(stored), header.warnings);
  header.space = templateOf(placementOf(stored));
  const int* extent = this->Voxels->GetDataExtent();
  header.dimensions = glm::ivec3(extent[1] + 1, extent[3] + 1, extent[5] + 1);
  if (this->reversesSlices())
  {
    header.worldFromVoxel = header.worldFromVoxel * voxelFromReversedSlices(header.dimensions.z);
  }
  const char* note = stored->GetDescrip();
  const bool saysUnknown = note && std::string(note).find(UnknownSidesNote) != std::string::npos;
  header.knowsSides = !saysUnknown && (stored->GetSFormCode() > 0 || stored->GetQFormCode() > 0);
  if (!header.knowsSides)
  {
    header.warnings.emplace_back(UnknownSidesWarning);
  }
  header.labels = niftiLabels(this->textOfExtensions(fileName, header));
  noteLabels(header);
  header.isLabelMap = stored->GetIntentCode() == vtkNIFTIImageHeader::IntentLabel;
}

std::string NIFTIVolume::textOfExtensions(const std::string& fileName, VolumeHeader& header)
{
  vtkNIFTIImageHeader* stored = this->Voxels->GetNIFTIHeader();
  const char* magic = stored->GetMagic();
  const bool isOneFile = magic && magic[0] == 'n' && magic[1] == '+';
  const auto voxels = isOneFile ? static_cast<std::uint64_t>(stored->GetVoxOffset())
                                : std::numeric_limits<std::uint64_t>::max();
  const Extensions extensions = extensionsOf(fileName, voxels);
  if (extensions.end > voxels)
  {
    header.warnings.push_back(joined("has its voxels at byte ", voxels,
      " (vox_offset), before the end of its extensions at byte ", extensions.end,
      "; these bytes count as voxels"));
  }
  return extensions.text;
}

bool NIFTIVolume::reversesSlices() const
{
  return this->Voxels->GetQFac() < 0.0;
}

NIFTIPlacement NIFTIVolume::placement() const
{
  return placementOf(this->Voxels->GetNIFTIHeader());
}

glm::dmat4 NIFTIVolume::inFileOrder(
  const glm::dmat4& worldFromVoxel, const glm::ivec3& dimensions) const
{
  glm::dmat4 world = worldFromVoxel;
  if (this->reversesSlices())
  {
    world[3] += world[2] * (dimensions.z - 1.0);
    world[2] = -world[2];
  }
  return world;
}

double NIFTIVolume::storedBytes(const VolumeHeader& header) const
{
  const bool isLoaded = this->Voxels->GetOutput()->GetNumberOfPoints() > 0; // of a time series
  return isLoaded ? 0.0 : this->Volumes * VolumeFile::storedBytes(header);
}

namespace
{
// Hands the progress of VTK's reader on, and a stop back.
struct ReaderWatch
{
  vtkAlgorithm* reader;
  const Progress& progress;
  bool isStopped = false;

  void report()
  {
    if (!this->isStopped && !this->progress(this->reader->GetProgress()))
    {
      this->isStopped = true;
      this->reader->SetAbortExecute(1);
    }
  }
};
}

// False: `progress` said stop. What was read is dropped then.
bool NIFTIVolume::isRead(int extent[6], const Progress& progress)
{
  ReaderWatch watch{ this->Voxels, progress };
  const auto observer =
    this->Voxels->AddObserver(vtkCommand::ProgressEvent, &watch, &ReaderWatch::report);
  this->Voxels->UpdateExtent(extent);
  this->Voxels->RemoveObserver(observer);
  if (watch.isStopped)
  {
    this->Voxels->SetAbortExecute(0);
    this->Voxels->GetOutput()->ReleaseData();
  }
  return !watch.isStopped;
}

void NIFTIVolume::load(std::size_t volume, const Progress& progress, StoredVoxels& voxels)
{
  this->Error.clear();
  // VTK takes the slices of the extent as the file numbers them, and reverses these.
  std::array<int, 6> extent = voxels.wanted;
  if (this->reversesSlices())
  {
    const int last = this->Voxels->GetDataExtent()[5];
    extent[4] = last - voxels.wanted[5];
    extent[5] = last - voxels.wanted[4];
  }
  if (!this->isRead(extent.data(), progress))
  {
    return;
  }
  if (!this->Error.empty())
  {
    throw Problem(this->Error);
  }
  vtkImageData* read = this->Voxels->GetOutput();
  voxels.firstComponent =
    static_cast<int>(volume) * (read->GetNumberOfScalarComponents() / this->Volumes);
  voxels.image = vtkSmartPointer<vtkImageData>::New();
  voxels.image->ShallowCopy(read);
  voxels.image->SetExtent(voxels.wanted.data());
  if (this->Volumes == 1)
  {
    read->ReleaseData(); // a time series is kept: its next step comes from it
  }
}

extern const VolumeFormat VolumesOfNIFTI{ "NIFTI", isNIFTIFile, makeVolumeFile<NIFTIVolume> };
}

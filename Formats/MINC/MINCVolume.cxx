// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Volumes in MINC2 files (.mnc), through libminc.
///
/// Their world is RAS, in mm. Whole numbers become real values, slice by slice, as the file says;
/// whole numbers of the classes "integer" and "label" stay as they are.
#include "Formats/Files/PlainFile.h"
#include "Formats/Files/Text.h"
#include "Formats/MINC/MINCAttributes.h"
#include "Formats/MINC/MINCAxis.h"
#include "Formats/Volumes/VolumeFile.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"

#include <minc2.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>

namespace brainshift
{
namespace
{
constexpr std::uint64_t MostSteps = 65536; // of an axis whose positions are listed, and labels
constexpr int MostAxes = 5;

// VTK's types by those of libminc.
const std::map<int, int> Types{ { MI_TYPE_BYTE, VTK_SIGNED_CHAR },
  { MI_TYPE_UBYTE, VTK_UNSIGNED_CHAR }, { MI_TYPE_SHORT, VTK_SHORT },
  { MI_TYPE_USHORT, VTK_UNSIGNED_SHORT }, { MI_TYPE_INT, VTK_INT },
  { MI_TYPE_UINT, VTK_UNSIGNED_INT }, { MI_TYPE_FLOAT, VTK_FLOAT },
  { MI_TYPE_DOUBLE, VTK_DOUBLE } };

bool beginsLikeHDF5(const std::string& fileName)
{
  return readBeginning(fileName, 4) == "\x89HDF";
}

// A file that is closed when it is no longer needed.
class OpenVolume
{
public:
  explicit OpenVolume(const std::string& fileName)
    : Good(miopen_volume(fileName.c_str(), MI2_OPEN_READ, &this->Handle) == MI_NOERROR)
  {
  }
  ~OpenVolume()
  {
    if (this->Good)
    {
      miclose_volume(this->Handle);
    }
  }
  OpenVolume(const OpenVolume&) = delete;
  OpenVolume& operator=(const OpenVolume&) = delete;

  bool isGood() const { return this->Good; }
  mihandle_t get() const { return this->Handle; }

private:
  mihandle_t Handle = nullptr;
  bool Good;
};

bool describe(midimhandle_t dimension, MINCAxis& axis)
{
  midimclass_t kind = MI_DIMCLASS_ANY;
  misize_t count = 0;
  char* name = nullptr;
  miboolean_t isUneven = 0;
  if (miget_dimension_sampling_flag(dimension, &isUneven) == MI_NOERROR)
  {
    axis.isEven = isUneven == 0;
  }
  const bool isGood = miget_dimension_name(dimension, &name) == MI_NOERROR &&
    miget_dimension_class(dimension, &kind) == MI_NOERROR &&
    miget_dimension_size(dimension, &count) == MI_NOERROR &&
    (kind == MI_DIMCLASS_RECORD || // components have no place
      (miget_dimension_start(dimension, MI_ORDER_FILE, &axis.start) == MI_NOERROR &&
        (miget_dimension_separation(dimension, MI_ORDER_FILE, &axis.step) == MI_NOERROR ||
          !axis.isEven)));
  axis.use = kind == MI_DIMCLASS_SPATIAL ? AxisUse::Space
    : kind == MI_DIMCLASS_TIME           ? AxisUse::Time
                                         : AxisUse::Components;
  axis.count = count;
  if (name)
  {
    axis.name = name;
    mifree_name(name);
  }
  char* units = nullptr;
  if (miget_dimension_units(dimension, &units) == MI_NOERROR && units)
  {
    axis.units = units;
    mifree_name(units);
  }
  if (isGood && !axis.isEven && axis.count <= MostSteps)
  {
    axis.positions.resize(axis.count);
    miget_dimension_offsets(dimension, axis.count, 0, axis.positions.data());
  }
  return isGood &&
    (axis.use != AxisUse::Space ||
      miget_dimension_cosines(dimension, &axis.cosines.x) == MI_NOERROR);
}

void axesOf(mihandle_t volume, std::vector<MINCAxis>& axes)
{
  int count = 0;
  const bool isCounted =
    miget_volume_dimension_count(volume, MI_DIMCLASS_ANY, MI_DIMATTR_ALL, &count) == MI_NOERROR;
  if (!isCounted || count < 3 || count > MostAxes)
  {
    throw Problem("has " + std::to_string(count) + " dimensions; it must have from 3 to " +
      std::to_string(MostAxes));
  }
  std::array<midimhandle_t, MostAxes> handles{};
  const int found = miget_volume_dimensions(
    volume, MI_DIMCLASS_ANY, MI_DIMATTR_ALL, MI_DIMORDER_FILE, count, handles.data());
  for (int i = 0; i < count; ++i)
  {
    MINCAxis axis;
    if (found == MI_ERROR || !describe(handles[static_cast<std::size_t>(i)], axis))
    {
      throw Problem("does not describe its dimension " + std::to_string(i));
    }
    axes.push_back(axis);
  }
}

// libminc takes the axes of image-min and image-max for the first ones of the image.
void requireLimits(const std::string& fileName)
{
  const std::string image = wordInMINC(fileName, "image/0/image", "dimorder");
  for (const char* name : { "image-min", "image-max" })
  {
    const std::string limit = wordInMINC(fileName, std::string("image/0/") + name, "dimorder");
    if ((image + ',').rfind(limit.empty() ? limit : limit + ',', 0) != 0)
    {
      throw Problem(joined("has an ", name, " along ", shownWords(limit),
        ", which must be the first axes of its image, ", shownWords(image)));
    }
  }
}

// The type that voxels are handed out in, and whether libminc scales them.
void readType(
  mihandle_t volume, const std::string& fileName, VolumeHeader& header, bool& areRealValues)
{
  mitype_t type = MI_TYPE_UNKNOWN;
  miclass_t kind = MI_CLASS_REAL;
  if (miget_data_type(volume, &type) != MI_NOERROR || miget_data_class(volume, &kind) != MI_NOERROR)
  {
    throw Problem("does not say the type of its voxels");
  }
  const auto known = Types.find(type);
  const bool isNumber = kind == MI_CLASS_REAL || kind == MI_CLASS_INT || kind == MI_CLASS_LABEL;
  if (known == Types.end() || !isNumber)
  {
    throw Problem("has voxels of the MINC type " + std::to_string(type) + ", class " +
      std::to_string(kind) + "; BrainShift reads whole and real numbers");
  }
  areRealValues = kind == MI_CLASS_REAL;
  if (areRealValues && type != MI_TYPE_FLOAT && type != MI_TYPE_DOUBLE)
  {
    requireLimits(fileName);
  }
  // float32 holds all digits of up to 3 bytes.
  const bool isWide = type == MI_TYPE_DOUBLE || type == MI_TYPE_INT || type == MI_TYPE_UINT;
  header.storedType = !areRealValues ? known->second : isWide ? VTK_DOUBLE : VTK_FLOAT;
}

std::vector<Label> labelsIn(mihandle_t volume)
{
  miclass_t kind = MI_CLASS_REAL;
  int count = 0;
  std::vector<Label> labels;
  if (miget_data_class(volume, &kind) != MI_NOERROR || kind != MI_CLASS_LABEL ||
    miget_number_of_defined_labels(volume, &count) != MI_NOERROR)
  {
    return labels;
  }
  for (int i = 0; i < count && i < static_cast<int>(MostSteps); ++i)
  {
    Label label;
    char* name = nullptr;
    if (miget_label_value_by_index(volume, i, &label.value) == MI_NOERROR &&
      miget_label_name(volume, label.value, &name) == MI_NOERROR && name)
    {
      label.name = name;
      mifree_name(name);
      labels.push_back(label);
    }
  }
  return labels;
}

// What a file does not say of its axes, or says in another length.
void noteMissing(const std::string& fileName, const std::vector<MINCAxis>& axes,
  std::vector<std::string>& warnings)
{
  for (const MINCAxis& axis : axes)
  {
    if (axis.use != AxisUse::Space)
    {
      continue;
    }
    const std::vector<std::string> missing = missingAttributes(fileName, axis.name,
      axis.isEven ? std::vector<std::string>{ "step", "start" } : std::vector<std::string>());
    for (const std::string& name : missing)
    {
      warnings.push_back("has no " + name + " along " + axis.name + ", which counts as " +
        (name == "step" ? "1" : "0"));
    }
  }
}

// Voxels of a file: the first one and how many, along each axis of the file.
struct Hyperslab
{
  std::vector<misize_t> start;
  std::vector<misize_t> count;
};

// Reads some slices along the slowest axis of space.
bool readSlices(mihandle_t volume, const Hyperslab& slab, bool areRealValues, vtkDataArray* to,
  vtkIdType firstValue)
{
  void* const place = to->GetVoidPointer(firstValue);
  const auto isType = [&](const auto& known) { return known.second == to->GetDataType(); };
  const auto type = std::find_if(Types.begin(), Types.end(), isType);
  const auto wanted = static_cast<mitype_t>(type->first);
  const int status = areRealValues
    ? miget_real_value_hyperslab(volume, wanted, slab.start.data(), slab.count.data(), place)
    : miget_voxel_value_hyperslab(volume, wanted, slab.start.data(), slab.count.data(), place);
  return status == MI_NOERROR;
}

// Whether a file exists and begins like HDF5, as MINC2 files do.
bool isMINCFile(const std::string& fileName)
{
  return beginsLikeHDF5(fileName);
}

class MINCVolume : public VolumeFile
{
public:
  std::string noun() const override { return "MINC volume"; }
  void readHeader(const std::string& fileName, VolumeHeader& header) override;
  void load(std::size_t volume, const Progress& progress, StoredVoxels& voxels) override;

private:
  // Reads the voxels of a time: one component, or all that are together. False if stopped.
  bool loadPart(mihandle_t file, std::size_t volume, std::optional<int> component,
    const Progress& progress, vtkDataArray* numbers) const;

  std::string FileName;
  std::vector<MINCAxis> Axes; // the slowest first
  bool AreRealValues = true;  // stored numbers are scaled
  VolumeHeader Header;
};

void MINCVolume::readHeader(const std::string& fileName, VolumeHeader& header)
{
  this->FileName = fileName;
  this->Axes.clear();
  requirePlainFile(fileName);
  if (readBeginning(fileName, 3) == "CDF")
  {
    throw Problem("is a MINC1 file, which MINC1 Volume Reader reads");
  }
  if (!beginsLikeHDF5(fileName))
  {
    throw Problem("is not MINC2: it does not begin like an HDF5 file");
  }
  const OpenVolume volume(fileName);
  if (!volume.isGood())
  {
    throw Problem("is not MINC2, or is damaged: libminc cannot open it");
  }
  axesOf(volume.get(), this->Axes);
  for (MINCAxis& axis : this->Axes)
  {
    axis.spaceType = wordInMINC(fileName, "dimensions/" + axis.name, "spacetype");
  }
  noteMissing(fileName, this->Axes, header.warnings);
  readType(volume.get(), fileName, header, this->AreRealValues);
  placeMINC(this->Axes, header);
  if (header.dimensions == glm::ivec3(1))
  {
    throw Problem("has 1 voxel; it must have at least 2");
  }
  header.labels = labelsIn(volume.get());
  this->Header = header;
}

void MINCVolume::load(std::size_t volume, const Progress& progress, StoredVoxels& voxels)
{
  const OpenVolume file(this->FileName);
  if (!file.isGood())
  {
    throw Problem("libminc cannot open it any more");
  }
  const glm::ivec3& sides = this->Header.dimensions;
  const int components = this->Header.components;
  const vtkIdType count = vtkIdType(sides.x) * sides.y * sides.z;
  auto numbers =
    vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(this->Header.storedType));
  numbers->SetNumberOfComponents(components);
  numbers->SetNumberOfTuples(count);
  const bool areTogether = this->Axes.back().use == AxisUse::Components || components == 1;
  if (areTogether)
  {
    if (!this->loadPart(file.get(), volume, {}, progress, numbers))
    {
      return;
    }
    voxels.show(sides, numbers);
    return;
  }
  auto part =
    vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(this->Header.storedType));
  part->SetNumberOfTuples(count);
  for (int component = 0; component < components; ++component)
  {
    const auto partly = [&](double fraction) {
      return progress((component + fraction) / components);
    };
    if (!this->loadPart(file.get(), volume, component, partly, part))
    {
      return;
    }
    numbers->CopyComponent(component, part, 0);
  }
  voxels.show(sides, numbers);
}

bool MINCVolume::loadPart(mihandle_t file, std::size_t volume, std::optional<int> component,
  const Progress& progress, vtkDataArray* numbers) const
{
  constexpr misize_t Slices = 32; // a block of compressed voxels has as many
  const glm::ivec3& sides = this->Header.dimensions;
  Hyperslab slab{ std::vector<misize_t>(this->Axes.size(), 0),
    std::vector<misize_t>(this->Axes.size(), 1) };
  std::size_t slowest = this->Axes.size();
  for (std::size_t i = 0; i < this->Axes.size(); ++i)
  {
    const AxisUse use = this->Axes[i].use;
    const bool isOne = use == AxisUse::Time || (use == AxisUse::Components && component);
    slab.start[i] = use == AxisUse::Time ? volume : isOne ? static_cast<misize_t>(*component) : 0;
    slab.count[i] = isOne ? 1 : this->Axes[i].count;
    slowest = use == AxisUse::Space ? std::min(slowest, i) : slowest;
  }
  const misize_t slices = slab.count[slowest];
  const vtkIdType sliceValues = vtkIdType(sides.x) * sides.y * numbers->GetNumberOfComponents();
  for (misize_t slice = 0; slice < slices; slice += Slices)
  {
    slab.start[slowest] = slice;
    slab.count[slowest] = std::min(Slices, slices - slice);
    if (!readSlices(
          file, slab, this->AreRealValues, numbers, static_cast<vtkIdType>(slice) * sliceValues))
    {
      throw Problem("libminc cannot read its slices from " + std::to_string(slice) + " on");
    }
    if (!progress(static_cast<double>(slice + slab.count[slowest]) / static_cast<double>(slices)))
    {
      return false;
    }
  }
  return true;
}
}

extern const VolumeFormat VolumesOfMINC{ "MINC", isMINCFile, makeVolumeFile<MINCVolume> };
}

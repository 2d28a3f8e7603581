// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Volumes in MINC1 files (.mnc), through the netCDF that ParaView brings.
///
/// Their world is RAS, in mm. Whole numbers become real values, slice by slice, as the file says:
/// the ends of valid_range are image-min and image-max, and what is outside counts as an end.
#include "Formats/Files/PlainFile.h"
#include "Formats/Files/Text.h"
#include "Formats/MINC/MINCAxis.h"
#include "Formats/MINC/NetCDFHeader.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"

#include "vtk_netcdf.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <type_traits>

namespace brainshift
{
namespace
{
constexpr int MostAxes = 5;
constexpr const char* Converted = "; make a MINC2 file of it by mincconvert -2";

// A file that is closed when it is no longer needed.
class OpenFile
{
public:
  // An absolute path: a name with a scheme before it would be an address in a network.
  explicit OpenFile(const std::string& fileName)
    : Good(nc_open(std::filesystem::absolute(fileName).string().c_str(), NC_NOWRITE, &this->Id) ==
        NC_NOERR)
  {
  }
  ~OpenFile()
  {
    if (this->Good)
    {
      nc_close(this->Id);
    }
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  bool isGood() const { return this->Good; }
  int get() const { return this->Id; }

private:
  int Id = -1;
  bool Good;
};

void require(int status, const std::string& what)
{
  if (status != NC_NOERR)
  {
    throw Problem(
      "is damaged: netCDF cannot read " + shownWords(what) + " (" + nc_strerror(status) + ")");
  }
}

// A name of at most NC_MAX_NAME letters.
template <typename Inquire>
std::string nameBy(const Inquire& inquire, const std::string& what)
{
  std::string name(NC_MAX_NAME + 1, '\0');
  require(inquire(name.data()), what);
  return name.c_str();
}

// Text of an attribute; empty if there is none.
std::string textOf(int file, int variable, const char* name)
{
  constexpr std::size_t LongestText = 1024;
  nc_type type = NC_NAT;
  std::size_t length = 0;
  if (nc_inq_att(file, variable, name, &type, &length) != NC_NOERR || type != NC_CHAR ||
    length > LongestText)
  {
    return {};
  }
  std::string text(length, '\0');
  require(nc_get_att_text(file, variable, name, text.data()), name);
  return text.c_str();
}

// Numbers of an attribute; none if there is no such attribute.
std::vector<double> numbersOf(int file, int variable, const char* name)
{
  constexpr std::size_t MostNumbers = 16;
  nc_type type = NC_NAT;
  std::size_t length = 0;
  if (nc_inq_att(file, variable, name, &type, &length) != NC_NOERR || type == NC_CHAR ||
    length > MostNumbers)
  {
    return {};
  }
  std::vector<double> numbers(length);
  require(nc_get_att_double(file, variable, name, numbers.data()), name);
  return numbers;
}

std::optional<int> variableNamed(int file, const std::string& name)
{
  int variable = -1;
  return nc_inq_varid(file, name.c_str(), &variable) == NC_NOERR ? std::optional<int>(variable)
                                                                 : std::nullopt;
}

std::vector<int> dimensionsOf(int file, int variable)
{
  int count = 0;
  require(nc_inq_varndims(file, variable, &count), "the dimensions of a variable");
  std::vector<int> dimensions(static_cast<std::size_t>(count));
  require(nc_inq_vardimid(file, variable, dimensions.data()), "the dimensions of a variable");
  return dimensions;
}

const std::map<std::string, glm::dvec3> SpaceAxes{ { "xspace", { 1.0, 0.0, 0.0 } },
  { "yspace", { 0.0, 1.0, 0.0 } }, { "zspace", { 0.0, 0.0, 1.0 } } };

// A missing step or start of an axis of space gets a warning.
void readAxisNumbers(int file, int variable, MINCAxis& axis, std::vector<std::string>& warnings)
{
  for (const auto& [name, number] : { std::pair{ "step", &axis.step }, { "start", &axis.start } })
  {
    const std::vector<double> numbers = numbersOf(file, variable, name);
    if (numbers.size() == 1 && std::isfinite(numbers.front()))
    {
      *number = numbers.front();
    }
    else if (axis.use == AxisUse::Space)
    {
      warnings.push_back(
        joined("has no ", name, " along ", axis.name, ", which counts as ", *number));
    }
  }
  const std::vector<double> cosines = numbersOf(file, variable, "direction_cosines");
  if (axis.use == AxisUse::Space && !cosines.empty())
  {
    if (cosines.size() != 3)
    {
      throw Problem(
        joined("has ", cosines.size(), " direction_cosines along ", axis.name, "; it must have 3"));
    }
    axis.cosines = glm::dvec3(cosines[0], cosines[1], cosines[2]);
  }
}

MINCAxis axisOf(int file, int dimension, std::vector<std::string>& warnings)
{
  constexpr std::size_t MostListed = 65536;
  MINCAxis axis;
  std::size_t count = 0;
  axis.name =
    nameBy([&](char* to) { return nc_inq_dim(file, dimension, to, &count); }, "a dimension");
  axis.count = count;
  const auto space = SpaceAxes.find(axis.name);
  const bool isSpace = space != SpaceAxes.end();
  if (!isSpace && axis.name != "time" && axis.name != "vector_dimension")
  {
    throw Problem("has the dimension " + shownWords(axis.name) +
      "; BrainShift reads xspace, yspace, zspace, time and vector_dimension");
  }
  axis.use = isSpace ? AxisUse::Space : axis.name == "time" ? AxisUse::Time : AxisUse::Components;
  axis.cosines = isSpace ? space->second : glm::dvec3(0.0);
  const std::optional<int> variable = variableNamed(file, axis.name);
  if (!variable || axis.use == AxisUse::Components)
  {
    if (isSpace)
    {
      throw Problem("has no variable " + axis.name + ", which gives the positions of its voxels");
    }
    return axis;
  }
  axis.units = textOf(file, *variable, "units");
  axis.spaceType = textOf(file, *variable, "spacetype");
  axis.isEven = textOf(file, *variable, "spacing").rfind("irregular", 0) != 0;
  if (isSpace && !axis.isEven)
  {
    throw Problem("has an irregular spacing along " + axis.name + Converted +
      ", whose positions BrainShift reads");
  }
  if (!axis.isEven && count <= MostListed &&
    dimensionsOf(file, *variable) == std::vector<int>{ dimension })
  {
    axis.positions.resize(count);
    require(nc_get_var_double(file, *variable, axis.positions.data()), axis.name);
  }
  readAxisNumbers(file, *variable, axis, warnings);
  return axis;
}

// How stored whole numbers become real values.
struct Ranges
{
  bool areNeeded = true; // numbers in floating point are real values
  double leastStored = 0.0;
  double mostStored = 0.0;
  std::vector<std::size_t> along; // axes of the image, by their places, that the others have
  std::vector<double> least;      // image-min
  std::vector<double> most;       // image-max
};

// What the image is stored as.
struct StoredType
{
  nc_type type = NC_NAT;
  bool isSigned = true;

  bool isReal() const { return this->type == NC_FLOAT || this->type == NC_DOUBLE; }
};

// Calls use(null pointer to T), T being the type of stored numbers.
template <typename Use>
auto withType(const StoredType& stored, const Use& use)
{
  switch (stored.type)
  {
    case NC_BYTE:
    case NC_CHAR:
      return stored.isSigned ? use(static_cast<std::int8_t*>(nullptr))
                             : use(static_cast<std::uint8_t*>(nullptr));
    case NC_SHORT:
      return stored.isSigned ? use(static_cast<std::int16_t*>(nullptr))
                             : use(static_cast<std::uint16_t*>(nullptr));
    case NC_INT:
      return stored.isSigned ? use(static_cast<std::int32_t*>(nullptr))
                             : use(static_cast<std::uint32_t*>(nullptr));
    case NC_FLOAT:
      return use(static_cast<float*>(nullptr));
    default:
      return use(static_cast<double*>(nullptr));
  }
}

StoredType typeOf(int file, int image)
{
  StoredType stored;
  require(nc_inq_vartype(file, image, &stored.type), "the type of voxels");
  const std::set<nc_type> known{ NC_BYTE, NC_CHAR, NC_SHORT, NC_INT, NC_FLOAT, NC_DOUBLE };
  if (known.count(stored.type) == 0)
  {
    throw Problem(joined(
      "has voxels of the netCDF type ", stored.type, "; BrainShift reads whole and real numbers"));
  }
  const std::string sign = textOf(file, image, "signtype");
  stored.isSigned =
    sign.empty() ? stored.type != NC_BYTE && stored.type != NC_CHAR : sign.rfind("signed", 0) == 0;
  return stored;
}

// The stored numbers whose real values are image-min and image-max.
void readStoredRange(int file, int image, const StoredType& stored, Ranges& ranges)
{
  double least = 0.0;
  double most = 0.0;
  withType(stored, [&](auto* none) {
    using Limits = std::numeric_limits<std::remove_pointer_t<decltype(none)>>;
    least = static_cast<double>(Limits::lowest());
    most = static_cast<double>(Limits::max());
  });
  std::vector<double> range = numbersOf(file, image, "valid_range");
  if (range.empty())
  {
    const std::vector<double> low = numbersOf(file, image, "valid_min");
    const std::vector<double> high = numbersOf(file, image, "valid_max");
    range = { low.empty() ? least : low.front(), high.empty() ? most : high.front() };
  }
  if (range.size() != 2 || !(range[0] < range[1]) || range[0] < least || range[1] > most)
  {
    throw Problem(joined("has a valid_range from ", range.front(), " to ", range.back(),
      "; it must grow, within ", least, " to ", most));
  }
  ranges.leastStored = range[0];
  ranges.mostStored = range[1];
}

std::vector<double> limitsNamed(int file, const char* name, std::vector<int>& dimensions)
{
  const std::optional<int> variable = variableNamed(file, name);
  if (!variable)
  {
    throw Problem(joined("has no ", name,
      ", which gives the real values of its whole numbers; add it by minc_modify_header"));
  }
  dimensions = dimensionsOf(file, *variable);
  double count = 1.0;
  for (const int dimension : dimensions)
  {
    std::size_t side = 0;
    require(nc_inq_dimlen(file, dimension, &side), name);
    count *= static_cast<double>(side);
  }
  std::vector<double> numbers(static_cast<std::size_t>(count));
  require(nc_get_var_double(file, *variable, numbers.data()), name);
  if (!std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); }))
  {
    throw Problem(joined("has an ", name, " that is no number"));
  }
  return numbers;
}

// The slowest axis of space: a slice is what is along the others.
std::size_t sliceAxisOf(const std::vector<MINCAxis>& axes)
{
  const auto isSpace = [](const MINCAxis& axis) { return axis.use == AxisUse::Space; };
  return static_cast<std::size_t>(std::find_if(axes.begin(), axes.end(), isSpace) - axes.begin());
}

void readRealRange(
  int file, const std::vector<int>& imageAxes, const std::vector<MINCAxis>& axes, Ranges& ranges)
{
  std::vector<int> dimensions;
  std::vector<int> ofLeast;
  ranges.most = limitsNamed(file, "image-max", dimensions);
  ranges.least = limitsNamed(file, "image-min", ofLeast);
  if (dimensions != ofLeast)
  {
    throw Problem("has an image-max and an image-min of different dimensions");
  }
  for (const int dimension : dimensions)
  {
    const auto place = static_cast<std::size_t>(
      std::find(imageAxes.begin(), imageAxes.end(), dimension) - imageAxes.begin());
    if (place == axes.size() || (axes[place].use != AxisUse::Time && place != sliceAxisOf(axes)))
    {
      throw Problem(std::string("has an image-max along an axis that is neither time nor that of "
                                "its slices") +
        Converted);
    }
    ranges.along.push_back(place);
  }
}

bool isMINC1File(const std::string& fileName)
{
  const std::string begin = readBeginning(fileName, 4);
  return begin == "CDF\x01" || begin == "CDF\x02";
}

class MINC1Volume : public VolumeFile
{
public:
  std::string noun() const override { return "MINC volume"; }
  void readHeader(const std::string& fileName, VolumeHeader& header) override;
  void load(std::size_t volume, const Progress& progress, StoredVoxels& voxels) override;

private:
  // Reads one slice of a time as real values, in the order of the file.
  void readSlice(int file, const std::vector<std::size_t>& start,
    const std::vector<std::size_t>& count, std::vector<double>& values) const;
  // Where the values of a slice belong: [row][column][component].
  std::vector<std::size_t> orderOfSlice() const;

  std::string FileName;
  std::vector<MINCAxis> Axes; // the slowest first
  StoredType Stored;
  Ranges Values;
  VolumeHeader Header;
};

void MINC1Volume::readHeader(const std::string& fileName, VolumeHeader& header)
{
  this->FileName = fileName;
  this->Axes.clear();
  this->Values = Ranges();
  requirePlainFile(fileName);
  if (!isMINC1File(fileName))
  {
    throw Problem("is not MINC1: it does not begin like a netCDF file");
  }
  requireWholeNetCDF(fileName);
  const OpenFile file(fileName);
  const std::optional<int> image =
    file.isGood() ? variableNamed(file.get(), "image") : std::nullopt;
  if (!image)
  {
    throw Problem(file.isGood() ? "is a netCDF file without a variable image, so it is not MINC1"
                                : "is not MINC1, or is damaged: netCDF cannot open it");
  }
  const std::vector<int> imageAxes = dimensionsOf(file.get(), *image);
  if (imageAxes.size() < 3 || imageAxes.size() > MostAxes ||
    std::set<int>(imageAxes.begin(), imageAxes.end()).size() != imageAxes.size())
  {
    throw Problem(joined("has an image of ", imageAxes.size(),
      " dimensions; it must have from 3 to ", MostAxes, ", each once"));
  }
  for (const int axis : imageAxes)
  {
    this->Axes.push_back(axisOf(file.get(), axis, header.warnings));
  }
  placeMINC(this->Axes, header);
  if (header.dimensions == glm::ivec3(1))
  {
    throw Problem("has 1 voxel; it must have at least 2");
  }
  this->Stored = typeOf(file.get(), *image);
  this->Values.areNeeded = !this->Stored.isReal();
  if (this->Values.areNeeded)
  {
    readStoredRange(file.get(), *image, this->Stored, this->Values);
    readRealRange(file.get(), imageAxes, this->Axes, this->Values);
  }
  // float32 holds all digits of up to 3 bytes.
  const bool isWide = this->Stored.type == NC_DOUBLE || this->Stored.type == NC_INT;
  header.storedType = isWide ? VTK_DOUBLE : VTK_FLOAT;
  this->Header = header;
}

std::vector<std::size_t> MINC1Volume::orderOfSlice() const
{
  // Steps in the output by axis of the file: the last axis of space is that of columns.
  const auto components = static_cast<std::size_t>(this->Header.components);
  const auto columns = static_cast<std::size_t>(this->Header.dimensions.x);
  const std::size_t slices = sliceAxisOf(this->Axes);
  std::vector<std::pair<std::size_t, std::size_t>> axes; // entries, step
  std::size_t spaces = 0;
  for (std::size_t i = 0; i < this->Axes.size(); ++i)
  {
    const MINCAxis& axis = this->Axes[i];
    if (axis.use == AxisUse::Components)
    {
      axes.emplace_back(axis.count, 1);
    }
    else if (axis.use == AxisUse::Space && i != slices)
    {
      axes.emplace_back(axis.count, spaces++ == 0 ? columns * components : components);
    }
  }
  std::vector<std::size_t> order{ 0 };
  for (const auto& [entries, step] : axes)
  {
    std::vector<std::size_t> longer;
    longer.reserve(order.size() * entries);
    for (const std::size_t before : order)
    {
      for (std::size_t i = 0; i < entries; ++i)
      {
        longer.push_back(before + i * step);
      }
    }
    order = std::move(longer);
  }
  return order;
}

void MINC1Volume::readSlice(int file, const std::vector<std::size_t>& start,
  const std::vector<std::size_t>& count, std::vector<double>& values) const
{
  std::size_t range = 0;
  for (const std::size_t axis : this->Values.along)
  {
    range = range * this->Axes[axis].count + start[axis];
  }
  const Ranges& known = this->Values;
  const double least = known.areNeeded ? known.least[range] : 0.0;
  const double slope =
    known.areNeeded ? (known.most[range] - least) / (known.mostStored - known.leastStored) : 1.0;
  withType(this->Stored, [&](auto* none) {
    std::vector<std::remove_pointer_t<decltype(none)>> stored(values.size());
    const std::optional<int> image = variableNamed(file, "image");
    require(
      image ? nc_get_vara(file, *image, start.data(), count.data(), stored.data()) : NC_ENOTVAR,
      "its slices");
    std::transform(stored.begin(), stored.end(), values.begin(), [&](auto number) {
      const auto real = static_cast<double>(number);
      return known.areNeeded ? least +
          slope * (std::clamp(real, known.leastStored, known.mostStored) - known.leastStored)
                             : real;
    });
  });
}

void MINC1Volume::load(std::size_t volume, const Progress& progress, StoredVoxels& voxels)
{
  const OpenFile file(this->FileName);
  if (!file.isGood())
  {
    throw Problem("netCDF cannot open it any more");
  }
  const glm::ivec3& sides = this->Header.dimensions;
  const std::size_t slices = sliceAxisOf(this->Axes);
  auto numbers =
    vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(this->Header.storedType));
  numbers->SetNumberOfComponents(this->Header.components);
  numbers->SetNumberOfTuples(vtkIdType(sides.x) * sides.y * sides.z);
  std::vector<std::size_t> start;
  std::vector<std::size_t> count;
  for (const MINCAxis& axis : this->Axes)
  {
    const bool isTime = axis.use == AxisUse::Time;
    start.push_back(isTime ? volume : 0);
    count.push_back(isTime ? 1 : axis.count);
  }
  count[slices] = 1;
  const std::vector<std::size_t> order = this->orderOfSlice();
  std::vector<double> values(order.size());
  for (int z = 0; z < sides.z; ++z)
  {
    start[slices] = static_cast<std::size_t>(z);
    this->readSlice(file.get(), start, count, values);
    const auto place = [&](auto* to) {
      using Number = std::remove_pointer_t<decltype(to)>;
      to += static_cast<std::size_t>(z) * order.size();
      for (std::size_t i = 0; i < order.size(); ++i)
      {
        to[order[i]] = static_cast<Number>(values[i]);
      }
    };
    if (this->Header.storedType == VTK_DOUBLE)
    {
      place(static_cast<double*>(numbers->GetVoidPointer(0)));
    }
    else
    {
      place(static_cast<float*>(numbers->GetVoidPointer(0)));
    }
    if (!progress((z + 1.0) / sides.z))
    {
      return;
    }
  }
  voxels.show(sides, numbers);
}
}

extern const VolumeFormat VolumesOfMINC1{ "MINC1", isMINC1File, makeVolumeFile<MINC1Volume> };
}

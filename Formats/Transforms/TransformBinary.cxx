// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Reads transforms in binary files: HDF5, by ParaView's own library, and MATLAB level 4 (ANTs'
/// 0GenericAffine.mat). Sizes are compared with the file, and with the memory, before anything is
/// taken.
#include "Common/Bytes.h"
#include "Common/HostMemory.h"
#include "Formats/Files/Text.h"
#include "Formats/Transforms/TransformRecord.h"

#include "vtk_hdf5.h"

#include <cstdint>
#include <utility>

namespace brainshift
{
namespace
{
constexpr int MostRecords = 1000;
constexpr std::size_t LongestType = 256; // letters

// An object of the library, closed at the end of the scope.
class Handle
{
public:
  Handle(hid_t id, herr_t (*close)(hid_t))
    : Id(id)
    , Close(close)
  {
  }
  ~Handle()
  {
    if (this->Id >= 0)
    {
      this->Close(this->Id);
    }
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

  bool isOpen() const { return this->Id >= 0; }
  operator hid_t() const { return this->Id; }

private:
  hid_t Id;
  herr_t (*Close)(hid_t);
};

// Keeps the library from writing its errors to the terminal.
class Silence
{
public:
  Silence()
  {
    H5Eget_auto2(H5E_DEFAULT, &this->Function, &this->Data);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Silence() { H5Eset_auto2(H5E_DEFAULT, this->Function, this->Data); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

private:
  H5E_auto2_t Function = nullptr;
  void* Data = nullptr;
};

// Whether a member is there. A link may lead to any file that the user may read; none is followed.
bool exists(hid_t group, const std::string& name)
{
  H5L_info_t link{};
  if (H5Lget_info(group, name.c_str(), &link, H5P_DEFAULT) < 0)
  {
    return false;
  }
  throwIfAny(link.type == H5L_TYPE_HARD ? ""
                                        : "has the member " + shownWords(name) +
        " as a link to another place or file; write the " + "transform into one file");
  return true;
}

// Numbers may be kept in other files, too.
void requireOwnNumbers(hid_t set, const std::string& name)
{
  const Handle made(H5Dget_create_plist(set), H5Pclose);
  throwIfAny(made.isOpen() && H5Pget_layout(made) != H5D_VIRTUAL && H5Pget_external_count(made) == 0
      ? ""
      : "has the numbers of " + name + " in another file; write the transform into one file");
}

// ITK once wrote Tranform for Transform, and reads both.
std::string nameIn(hid_t group, const std::string& end)
{
  return exists(group, "Transform" + end) ? "Transform" + end : "Tranform" + end;
}

std::string readType(hid_t group)
{
  const Problem problem("has a transform without a type");
  const bool isThere = exists(group, "TransformType");
  const Handle set(isThere ? H5Dopen2(group, "TransformType", H5P_DEFAULT) : hid_t(-1), H5Dclose);
  const Handle stored(set.isOpen() ? H5Dget_type(set) : hid_t(-1), H5Tclose);
  const Handle space(set.isOpen() ? H5Dget_space(set) : hid_t(-1), H5Sclose);
  if (!stored.isOpen() || !space.isOpen() || H5Tget_class(stored) != H5T_STRING ||
    H5Sget_simple_extent_npoints(space) != 1)
  {
    throw problem;
  }
  requireOwnNumbers(set, "TransformType");
  const Handle memory(H5Tcopy(stored), H5Tclose);
  if (H5Tis_variable_str(stored) > 0)
  {
    char* text = nullptr;
    if (H5Dread(set, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, static_cast<void*>(&text)) < 0 || !text)
    {
      throw problem;
    }
    std::string type = text;
    H5free_memory(text);
    return type.size() <= LongestType ? type : throw problem;
  }
  const std::size_t size = H5Tget_size(stored);
  std::string text(std::min(size, LongestType) + 1, '\0');
  if (size == 0 || size > LongestType ||
    H5Dread(set, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()) < 0)
  {
    throw problem;
  }
  return text.c_str(); // a 0 ends it
}

std::vector<double> readNumbers(hid_t group, const std::string& name)
{
  if (!exists(group, name))
  {
    return {}; // an identity has none
  }
  const Problem problem("has damaged numbers in " + name);
  const Handle set(H5Dopen2(group, name.c_str(), H5P_DEFAULT), H5Dclose);
  const Handle stored(set.isOpen() ? H5Dget_type(set) : hid_t(-1), H5Tclose);
  const Handle space(set.isOpen() ? H5Dget_space(set) : hid_t(-1), H5Sclose);
  const hssize_t count = space.isOpen() ? H5Sget_simple_extent_npoints(space) : -1;
  if (set.isOpen())
  {
    requireOwnNumbers(set, name);
  }
  if (count < 0 || !stored.isOpen() || H5Tget_class(stored) != H5T_FLOAT)
  {
    throw problem;
  }
  withBeginning("cannot be read: ", [&] {
    requireHostMemory(
      "a list of " + std::to_string(count) + " parameters", 2.0 * sizeof(double) * double(count));
  });
  std::vector<double> numbers(static_cast<std::size_t>(count));
  if (H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()) < 0)
  {
    throw problem;
  }
  return numbers;
}

TransformRecord readRecord(hid_t group)
{
  TransformRecord record;
  record.type = readType(group);
  record.parameters = readNumbers(group, nameIn(group, "Parameters"));
  record.fixed = readNumbers(group, nameIn(group, "FixedParameters"));
  return record;
}

constexpr std::int32_t Doubles = 0; // the header's type: little-endian, a full matrix
constexpr std::int32_t Floats = 10;
constexpr std::int32_t BigEndian = 1000; // is added to it
constexpr std::int32_t LongestName = 256;

// A variable of the file: what level 4 stores before its numbers.
struct Variable
{
  std::int32_t type;
  std::int32_t rows;
  std::int32_t columns;
  std::int32_t isComplex;
  std::int32_t nameLength;
};

void requireVariable(const Variable& variable)
{
  const bool good = (variable.type == Doubles || variable.type == Floats) && variable.rows >= 0 &&
    variable.columns >= 0 && variable.isComplex == 0 && variable.nameLength > 0 &&
    variable.nameLength <= LongestName;
  if (!good)
  {
    throw Problem("is no MATLAB file of level 4 with real numbers");
  }
}

// Reads the variable at `at` and moves behind it.
void readVariable(
  const std::string& bytes, std::size_t& at, std::string& name, std::vector<double>& numbers)
{
  const std::string tooShort = "ends within a variable";
  if (bytes.size() - at < sizeof(Variable))
  {
    throw Problem(tooShort);
  }
  const auto first = storedNumber<std::int32_t>(bytes.data() + at, false);
  const bool isBigEndian = first != Doubles && first != Floats;
  std::int32_t words[5];
  for (int i = 0; i < 5; ++i)
  {
    words[i] = storedNumber<std::int32_t>(bytes.data() + at + 4 * i, isBigEndian);
  }
  const std::int64_t type = std::int64_t(words[0]) - (isBigEndian ? BigEndian : 0);
  const bool isKnown = type >= Doubles && type <= Floats; // others may be beyond 32 bits
  Variable variable{ isKnown ? static_cast<std::int32_t>(type) : -1, words[1], words[2], words[3],
    words[4] };
  requireVariable(variable);
  at += sizeof(Variable);
  const std::size_t size = variable.type == Doubles ? sizeof(double) : sizeof(float);
  const auto nameLength = static_cast<std::size_t>(variable.nameLength);
  const std::size_t left = bytes.size() - at;
  const std::size_t count = static_cast<std::size_t>(variable.rows) * variable.columns;
  if (nameLength > left || count > (left - nameLength) / size)
  {
    throw Problem(tooShort);
  }
  name = std::string(bytes.data() + at, nameLength).c_str(); // a 0 ends it
  at += nameLength;
  numbers.resize(count);
  for (double& number : numbers)
  {
    number = variable.type == Doubles ? storedNumber<double>(bytes.data() + at, isBigEndian)
                                      : storedNumber<float>(bytes.data() + at, isBigEndian);
    at += size;
  }
}
}

bool isHDF5(const std::string& fileName)
{
  const Silence silence;
  return H5Fis_hdf5(fileName.c_str()) > 0;
}

std::vector<TransformRecord> readHDF5Records(const std::string& fileName)
{
  const Silence silence;
  const Handle file(H5Fopen(fileName.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  const bool isThere = file.isOpen() && exists(file, "TransformGroup");
  const Handle all(isThere ? H5Gopen2(file, "TransformGroup", H5P_DEFAULT) : hid_t(-1), H5Gclose);
  if (!all.isOpen())
  {
    throw Problem("is damaged, or holds no transforms of ITK (/TransformGroup)");
  }
  std::vector<TransformRecord> records;
  for (int number = 0; number < MostRecords && exists(all, std::to_string(number)); ++number)
  {
    const Handle group(H5Gopen2(all, std::to_string(number).c_str(), H5P_DEFAULT), H5Gclose);
    throwIfAny(group.isOpen() ? "" : "has a damaged transform");
    records.push_back(readRecord(group));
  }
  H5G_info_t info{};
  const bool isCounted = H5Gget_info(all, &info) >= 0;
  if (!isCounted || info.nlinks != records.size())
  {
    throw Problem("has " + std::to_string(info.nlinks) + " members in /TransformGroup, of which " +
      std::to_string(records.size()) + " are numbered from 0 on without a gap");
  }
  return records;
}

std::vector<TransformRecord> readMatlabRecords(const std::string& bytes)
{
  std::vector<TransformRecord> records;
  std::size_t at = 0;
  while (at < bytes.size())
  {
    std::string name;
    std::vector<double> numbers;
    readVariable(bytes, at, name, numbers);
    if (name != "fixed")
    {
      records.push_back({ name, std::move(numbers), {} });
    }
    else if (!records.empty())
    {
      records.back().fixed = std::move(numbers);
    }
    else
    {
      throw Problem("names the fixed parameters of no transform");
    }
  }
  return records;
}
}

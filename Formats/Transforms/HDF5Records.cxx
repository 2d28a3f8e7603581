// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Transforms/TransformBinary.h"

#include "Common/HostMemory.h"

#include "vtk_hdf5.h"

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

bool exists(hid_t group, const std::string& name)
{
  return H5Lexists(group, name.c_str(), H5P_DEFAULT) > 0;
}

// ITK once wrote Tranform for Transform, and reads both.
std::string nameIn(hid_t group, const std::string& end)
{
  return exists(group, "Transform" + end) ? "Transform" + end : "Tranform" + end;
}

std::string readType(hid_t group, std::string& type)
{
  const std::string problem = "has a transform without a type";
  const Handle set(H5Dopen2(group, "TransformType", H5P_DEFAULT), H5Dclose);
  const Handle stored(set.isOpen() ? H5Dget_type(set) : hid_t(-1), H5Tclose);
  const Handle space(set.isOpen() ? H5Dget_space(set) : hid_t(-1), H5Sclose);
  if (!stored.isOpen() || !space.isOpen() || H5Tget_class(stored) != H5T_STRING ||
    H5Sget_simple_extent_npoints(space) != 1)
  {
    return problem;
  }
  if (H5Tis_variable_str(stored) > 0)
  {
    char* text = nullptr;
    const Handle memory(H5Tcopy(stored), H5Tclose);
    if (H5Dread(set, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, static_cast<void*>(&text)) < 0 || !text)
    {
      return problem;
    }
    type = text;
    H5free_memory(text);
    return type.size() <= LongestType ? std::string() : problem;
  }
  const std::size_t size = H5Tget_size(stored);
  if (size == 0 || size > LongestType)
  {
    return problem;
  }
  std::string text(size + 1, '\0');
  const Handle memory(H5Tcopy(stored), H5Tclose);
  if (H5Dread(set, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()) < 0)
  {
    return problem;
  }
  type = text.c_str(); // a 0 ends it
  return {};
}

std::string readNumbers(hid_t group, const std::string& name, std::vector<double>& numbers)
{
  if (!exists(group, name))
  {
    return {}; // an identity has none
  }
  const std::string problem = "has damaged numbers in " + name;
  const Handle set(H5Dopen2(group, name.c_str(), H5P_DEFAULT), H5Dclose);
  const Handle stored(set.isOpen() ? H5Dget_type(set) : hid_t(-1), H5Tclose);
  const Handle space(set.isOpen() ? H5Dget_space(set) : hid_t(-1), H5Sclose);
  const hssize_t count = space.isOpen() ? H5Sget_simple_extent_npoints(space) : -1;
  if (count < 0 || !stored.isOpen() || H5Tget_class(stored) != H5T_FLOAT)
  {
    return problem;
  }
  const std::string tooMany = hostMemoryProblem(
    "a list of " + std::to_string(count) + " parameters", 2.0 * sizeof(double) * double(count));
  if (!tooMany.empty())
  {
    return "cannot be read: " + tooMany;
  }
  numbers.resize(static_cast<std::size_t>(count));
  return H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()) < 0
    ? problem
    : std::string();
}

std::string readRecord(hid_t group, TransformRecord& record)
{
  std::string problem = readType(group, record.type);
  problem =
    problem.empty() ? readNumbers(group, nameIn(group, "Parameters"), record.parameters) : problem;
  return problem.empty() ? readNumbers(group, nameIn(group, "FixedParameters"), record.fixed)
                         : problem;
}
}

bool isHDF5(const std::string& fileName)
{
  const Silence silence;
  return H5Fis_hdf5(fileName.c_str()) > 0;
}

std::string readHDF5Records(const std::string& fileName, std::vector<TransformRecord>& records)
{
  const Silence silence;
  const Handle file(H5Fopen(fileName.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  const Handle all(
    file.isOpen() ? H5Gopen2(file, "/TransformGroup", H5P_DEFAULT) : hid_t(-1), H5Gclose);
  if (!all.isOpen())
  {
    return "is damaged, or holds no transforms of ITK (/TransformGroup)";
  }
  for (int number = 0; number < MostRecords && exists(all, std::to_string(number)); ++number)
  {
    const Handle group(H5Gopen2(all, std::to_string(number).c_str(), H5P_DEFAULT), H5Gclose);
    records.emplace_back();
    const std::string problem =
      group.isOpen() ? readRecord(group, records.back()) : "has a damaged transform";
    if (!problem.empty())
    {
      return problem;
    }
  }
  return {};
}
}

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Asks ParaView's own HDF5, as TransformBinary does: libminc has no call for attributes of axes.
#include "Formats/MINC/MINCAttributes.h"

#include "vtk_hdf5.h"

namespace brainshift
{
namespace
{
// A file that is closed when it is no longer needed. HDF5 writes no errors to the terminal as long.
class QuietFile
{
public:
  explicit QuietFile(const std::string& fileName)
  {
    H5Eget_auto2(H5E_DEFAULT, &this->Print, &this->Data);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    this->Id = H5Fopen(fileName.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  }
  ~QuietFile()
  {
    if (this->Id >= 0)
    {
      H5Fclose(this->Id);
    }
    H5Eset_auto2(H5E_DEFAULT, this->Print, this->Data);
  }
  QuietFile(const QuietFile&) = delete;
  QuietFile& operator=(const QuietFile&) = delete;

  hid_t get() const { return this->Id; }

private:
  H5E_auto2_t Print = nullptr;
  void* Data = nullptr;
  hid_t Id = -1;
};
}

std::vector<std::string> missingAttributes(
  const std::string& fileName, const std::string& axis, const std::vector<std::string>& attributes)
{
  const QuietFile file(fileName);
  const std::string path = "/minc-2.0/dimensions/" + axis;
  std::vector<std::string> missing;
  for (const std::string& name : attributes)
  {
    if (file.get() < 0 ||
      H5Aexists_by_name(file.get(), path.c_str(), name.c_str(), H5P_DEFAULT) <= 0)
    {
      missing.push_back(name);
    }
  }
  return missing;
}

std::string wordInMINC(
  const std::string& fileName, const std::string& object, const std::string& name)
{
  constexpr std::size_t LongestWord = 1024;
  const QuietFile file(fileName);
  const std::string path = "/minc-2.0/" + object;
  const hid_t attribute =
    H5Aopen_by_name(file.get(), path.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
  if (attribute < 0)
  {
    return {};
  }
  const hid_t type = H5Aget_type(attribute);
  std::string word(LongestWord, '\0');
  const bool isRead = H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0 &&
    H5Tget_size(type) <= LongestWord && H5Aread(attribute, type, word.data()) >= 0;
  H5Tclose(type);
  H5Aclose(attribute);
  return isRead ? word.c_str() : "";
}
}

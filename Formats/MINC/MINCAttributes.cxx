// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Asks ParaView's own HDF5, as TransformBinary does: libminc has no call for attributes of axes.
#include "Formats/MINC/MINCAttributes.h"

#include "vtk_hdf5.h"

namespace brainshift
{
std::vector<std::string> missingAttributes(
  const std::string& fileName, const std::string& axis, const std::vector<std::string>& attributes)
{
  H5E_auto2_t print = nullptr;
  void* data = nullptr;
  H5Eget_auto2(H5E_DEFAULT, &print, &data);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); // no errors on the terminal
  const hid_t file = H5Fopen(fileName.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const std::string path = "/minc-2.0/dimensions/" + axis;
  std::vector<std::string> missing;
  for (const std::string& attribute : attributes)
  {
    if (file < 0 || H5Aexists_by_name(file, path.c_str(), attribute.c_str(), H5P_DEFAULT) <= 0)
    {
      missing.push_back(attribute);
    }
  }
  if (file >= 0)
  {
    H5Fclose(file);
  }
  H5Eset_auto2(H5E_DEFAULT, print, data);
  return missing;
}
}

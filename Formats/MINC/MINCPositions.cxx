// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/MINC/MINCPositions.h"

#include "Formats/Files/HDF5Objects.h" // ParaView's library: libminc has another one

#include <algorithm>
#include <cmath>

namespace brainshift
{
std::vector<double> positionsAlong(
  const std::string& fileName, const std::string& axis, std::size_t count)
{
  const HDF5Silence silence;
  const std::string path = "/minc-2.0/dimensions/" + axis;
  const HDF5Handle file(H5Fopen(fileName.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  const HDF5Handle set(
    file.isOpen() ? H5Dopen2(file, path.c_str(), H5P_DEFAULT) : hid_t(-1), H5Dclose);
  const HDF5Handle space(set.isOpen() ? H5Dget_space(set) : hid_t(-1), H5Sclose);
  const HDF5Handle stored(set.isOpen() ? H5Dget_type(set) : hid_t(-1), H5Tclose);
  const H5T_class_t kind = stored.isOpen() ? H5Tget_class(stored) : H5T_NO_CLASS;
  const bool isList = space.isOpen() && (kind == H5T_FLOAT || kind == H5T_INTEGER) &&
    H5Sget_simple_extent_npoints(space) == static_cast<hssize_t>(count);
  std::vector<double> positions(isList ? count : 0);
  const bool isRead =
    isList && H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, positions.data()) >= 0;
  const bool isFinite = std::all_of(
    positions.begin(), positions.end(), [](double position) { return std::isfinite(position); });
  return isRead && isFinite ? positions : std::vector<double>();
}
}

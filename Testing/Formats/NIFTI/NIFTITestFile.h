// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Writes small NIfTI files byte by byte, so that a test knows what is in them and can damage them.
#ifndef BrainShift_NIFTITestFile_h
#define BrainShift_NIFTITestFile_h

#include "vtk_zlib.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

namespace brainshift::testing
{
template <typename T>
inline constexpr int NIFTIType = 0;
template <>
inline constexpr int NIFTIType<std::uint8_t> = 2;
template <>
inline constexpr int NIFTIType<std::int16_t> = 4;
template <>
inline constexpr int NIFTIType<std::int32_t> = 8;
template <>
inline constexpr int NIFTIType<float> = 16;
template <>
inline constexpr int NIFTIType<double> = 64;
template <>
inline constexpr int NIFTIType<std::uint16_t> = 512;

// What a test may choose of a NIfTI-1 header, and voxels that number themselves 1, 2, 3, ...
struct NIFTITestFile
{
  std::vector<int> dimensions{ 4, 3, 5 };
  int dataType = NIFTIType<std::int16_t>;
  double slope = 0.0;
  double intercept = 0.0;
  double qfac = 1.0;
  std::array<double, 4> pixelSize{ 1.0, 1.0, 1.0, 0.0 }; // the fourth: time step
  int units = 2 + 8;                                     // mm, s
  int qformCode = 0;
  glm::dvec3 quaternion{ 0.0 };
  glm::dvec3 qformOffset{ 0.0 };
  int sformCode = 0;
  glm::dmat4 sform{ 1.0 };
  double voxelOffset = 352.0;
  double timeOffset = 0.0;
  std::string magic = "n+1";
  bool swapped = false;

  int count() const
  {
    int product = 1;
    for (int side : this->dimensions)
    {
      product *= side;
    }
    return product;
  }

  template <typename T>
  void put(std::vector<char>& bytes, std::size_t offset, T value) const
  {
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), &value, sizeof(T));
    for (std::size_t i = 0; i < sizeof(T); ++i)
    {
      bytes[offset + i] = raw[this->swapped ? sizeof(T) - 1 - i : i];
    }
  }

  std::vector<char> header() const
  {
    const auto f = [](double value) { return static_cast<float>(value); };
    const auto s = [](int value) { return static_cast<std::int16_t>(value); };
    std::vector<char> bytes(352, 0);
    this->put<std::int32_t>(bytes, 0, 348);
    this->put(bytes, 40, s(static_cast<int>(this->dimensions.size())));
    for (std::size_t i = 0; i < 7; ++i)
    {
      this->put(bytes, 42 + 2 * i, s(i < this->dimensions.size() ? this->dimensions[i] : 1));
    }
    this->put(bytes, 70, s(this->dataType));
    this->put(bytes, 76, f(this->qfac));
    for (std::size_t i = 0; i < 4; ++i)
    {
      this->put(bytes, 80 + 4 * i, f(this->pixelSize[i]));
    }
    this->put(bytes, 108, f(this->voxelOffset));
    this->put(bytes, 112, f(this->slope));
    this->put(bytes, 116, f(this->intercept));
    bytes[123] = static_cast<char>(this->units);
    this->put(bytes, 136, f(this->timeOffset));
    this->put(bytes, 252, s(this->qformCode));
    this->put(bytes, 254, s(this->sformCode));
    for (int i = 0; i < 3; ++i)
    {
      this->put(bytes, 256 + 4 * i, f(this->quaternion[i]));
      this->put(bytes, 268 + 4 * i, f(this->qformOffset[i]));
      for (int column = 0; column < 4; ++column)
      {
        this->put(bytes, 280 + 16 * i + 4 * column, f(this->sform[column][i]));
      }
    }
    std::copy(this->magic.begin(), this->magic.end(), bytes.begin() + 344);
    return bytes;
  }

  template <typename T>
  std::vector<char> voxels() const
  {
    std::vector<char> bytes(sizeof(T) * this->count());
    for (int i = 0; i < this->count(); ++i)
    {
      this->put(bytes, sizeof(T) * i, static_cast<T>(i + 1));
    }
    return bytes;
  }

  template <typename T = std::int16_t>
  std::vector<char> bytes() const
  {
    std::vector<char> all = this->header();
    const std::vector<char> voxels = this->voxels<T>();
    all.insert(all.end(), voxels.begin(), voxels.end());
    return all;
  }
};

inline NIFTITestFile withSform(const glm::dmat4& sform)
{
  NIFTITestFile file;
  file.sformCode = 1;
  file.sform = sform;
  return file;
}

inline void writePlain(const std::string& fileName, const std::vector<char>& bytes)
{
  std::ofstream(fileName, std::ios::binary).write(bytes.data(), bytes.size());
}

inline void writePacked(const std::string& fileName, const std::vector<char>& bytes)
{
  gzFile file = gzopen(fileName.c_str(), "wb");
  gzwrite(file, bytes.data(), static_cast<unsigned int>(bytes.size()));
  gzclose(file);
}
}

#endif

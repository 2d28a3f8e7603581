// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/NIFTI/NIFTIFileCheck.h"

#include "Common/Bytes.h"
#include "Formats/Files/PlainFile.h"

#include "vtk_zlib.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <sstream>

namespace
{
constexpr int NIFTI1Bytes = 348;
constexpr int NIFTI2Bytes = 540;
constexpr std::int64_t MostTimeSteps = 65536;  // and numbers for a voxel: each takes memory
constexpr double LargestDeflateRatio = 1032.0; // no zlib stream unpacks to more times its size

// Bytes of a voxel for each data type that vtkNIFTIImageReader knows.
const std::map<int, int> VoxelBytes{ { 2, 1 }, { 4, 2 }, { 8, 4 }, { 16, 4 }, { 32, 8 }, { 64, 8 },
  { 128, 3 }, { 256, 1 }, { 512, 2 }, { 768, 4 }, { 1024, 8 }, { 1280, 8 }, { 1792, 16 },
  { 2304, 4 } };

// The first bytes of a file, unpacked.
struct RawHeader
{
  std::array<unsigned char, NIFTI2Bytes> bytes{};
  int count = 0; // bytes that are there
  bool opened = false;
  int version = 0; // 1 or 2; 0: not NIfTI
  bool isBigEndian = false;

  template <typename T>
  T number(int offset) const
  {
    return brainshift::storedNumber<T>(this->bytes.data() + offset, this->isBigEndian);
  }

  bool hasMagic(int offset, unsigned char digit) const
  {
    const unsigned char* magic = this->bytes.data() + offset;
    return magic[0] == 'n' && (magic[1] == '+' || magic[1] == 'i') && magic[2] == digit &&
      magic[3] == 0;
  }

  bool isSingleFile() const { return this->bytes[this->version == 1 ? 345 : 5] == '+'; }
  int dataType() const { return this->number<std::int16_t>(this->version == 1 ? 70 : 12); }
  double voxelOffset() const
  {
    return this->version == 1 ? this->number<float>(108)
                              : static_cast<double>(this->number<std::int64_t>(168));
  }
  std::int64_t dimension(int axis) const
  {
    return this->version == 1 ? this->number<std::int16_t>(40 + 2 * axis)
                              : this->number<std::int64_t>(16 + 8 * axis);
  }
};

// The other file of a pair .hdr and .img, either of them packed or not: an existing file whose name
// has `wanted` in place of `given`. Names without `given` stay.
std::string siblingOf(
  const std::string& fileName, const std::string& given, const std::string& wanted)
{
  const std::filesystem::path path(fileName);
  const bool named = path.extension() == ".gz";
  std::filesystem::path stem = named ? path.parent_path() / path.stem() : path;
  if (stem.extension() != given)
  {
    return fileName;
  }
  const std::string plain = stem.replace_extension(wanted).string();
  const std::string packed = plain + ".gz";
  std::error_code error;
  const bool packedExists = std::filesystem::exists(packed, error);
  const bool plainExists = std::filesystem::exists(plain, error);
  return packedExists && (named || !plainExists) ? packed : plain;
}

bool isPacked(const std::string& fileName)
{
  gzFile file = gzopen(fileName.c_str(), "rb");
  const bool packed = file && gzdirect(file) == 0;
  gzclose(file);
  return packed;
}

RawHeader readHeader(const std::string& fileName)
{
  RawHeader header;
  const std::string headerName = siblingOf(fileName, ".img", ".hdr");
  if (!brainshift::plainFileProblem(headerName).empty())
  {
    return header; // a pipe would never open
  }
  gzFile file = gzopen(headerName.c_str(), "rb");
  if (!file)
  {
    return header;
  }
  header.opened = true;
  header.count = std::max(0, gzread(file, header.bytes.data(), NIFTI2Bytes));
  gzclose(file);
  if (header.count >= NIFTI1Bytes && header.hasMagic(344, '1'))
  {
    header.version = 1;
  }
  else if (header.count >= NIFTI2Bytes && header.hasMagic(4, '2'))
  {
    header.version = 2;
  }
  const std::int64_t rank = header.version > 0 ? header.dimension(0) : 0;
  header.isBigEndian = rank < 0 || rank > 7; // the standard's test
  return header;
}

std::string headerProblem(const RawHeader& header)
{
  std::ostringstream problem;
  if (header.count < NIFTI1Bytes)
  {
    problem << "has " << header.count << " readable bytes; a NIfTI header has " << NIFTI1Bytes;
  }
  else if (header.version == 0)
  {
    problem << "is not NIfTI: its magic is neither n+1, ni1, n+2 nor ni2";
  }
  else if (VoxelBytes.count(header.dataType()) == 0)
  {
    problem << "has NIfTI data type " << header.dataType() << "; BrainShift reads the types";
    for (const auto& known : VoxelBytes)
    {
      problem << " " << known.first;
    }
  }
  else if (header.isSingleFile() && !(header.voxelOffset() >= NIFTI1Bytes))
  {
    problem << "has its voxels at byte " << header.voxelOffset() << "; the first possible byte is "
            << NIFTI1Bytes;
  }
  return problem.str();
}

std::string dimensionsProblem(const RawHeader& header)
{
  std::ostringstream problem;
  const std::int64_t rank = header.dimension(0);
  if (rank < 1 || rank > 7)
  {
    problem << "has " << rank << " dimensions; it must have from 1 to 7";
    return problem.str();
  }
  bool oneVoxel = true;
  for (int axis = 1; axis <= rank; ++axis)
  {
    const std::int64_t size = header.dimension(axis);
    const std::int64_t limit = axis < 4 ? std::numeric_limits<std::int32_t>::max()
      : axis < 6                        ? MostTimeSteps
                                        : 1;
    oneVoxel = oneVoxel && (size == 1 || axis > 3);
    if (size < 1 || size > limit)
    {
      problem << "has " << size << " entries in dimension " << axis << "; it must have from 1 to "
              << limit;
      return problem.str();
    }
  }
  if (oneVoxel)
  {
    problem << "has 1 voxel; it must have at least 2";
  }
  return problem.str();
}

std::string sizeProblem(const RawHeader& header, const std::string& fileName)
{
  double wanted = VoxelBytes.at(header.dataType());
  for (int axis = 1; axis <= header.dimension(0); ++axis)
  {
    wanted *= static_cast<double>(header.dimension(axis));
  }
  wanted += header.voxelOffset();
  const std::string dataName =
    header.isSingleFile() ? fileName : siblingOf(fileName, ".hdr", ".img");
  std::error_code error;
  const auto stored = std::filesystem::file_size(dataName, error);
  const std::string notPlain = brainshift::plainFileProblem(dataName);
  const bool packed = notPlain.empty() && isPacked(dataName);
  std::ostringstream problem;
  problem.precision(15);
  if (!notPlain.empty())
  {
    problem << "has no voxels: " << dataName << " " << notPlain;
  }
  else if (error)
  {
    problem << "has no voxels: the size of " << dataName << " is not known";
  }
  else if (static_cast<double>(stored) * (packed ? LargestDeflateRatio : 1.0) < wanted)
  {
    problem << "is truncated: " << dataName << " has " << stored << (packed ? " packed" : "")
            << " bytes where the header announces " << wanted;
  }
  return problem.str();
}
}

namespace brainshift
{
bool isNIFTIFile(const std::string& fileName)
{
  return readHeader(fileName).version > 0;
}

std::string niftiFileProblem(const std::string& fileName)
{
  const std::string notPlain = plainFileProblem(fileName);
  if (!notPlain.empty())
  {
    return notPlain;
  }
  const RawHeader header = readHeader(fileName);
  if (!header.opened)
  {
    return "cannot be opened";
  }
  std::string problem = headerProblem(header);
  if (problem.empty())
  {
    problem = dimensionsProblem(header);
  }
  if (problem.empty())
  {
    problem = sizeProblem(header, fileName);
  }
  return problem;
}
}

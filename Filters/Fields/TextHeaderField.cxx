// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Fields/TextHeaderField.h"

#include "Filters/Attached/HostMemory.h"
#include "Filters/Files/PlainFile.h"
#include "Filters/Files/TextHeader.h"
#include "Filters/Files/WholeFile.h"

#include "vtk_zlib.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

namespace brainshift
{
namespace
{
constexpr int DetectZlibOrGzip = 15 + 32; // zlib's window bits

bool thisMachineIsBigEndian()
{
  const int one = 1;
  char first;
  std::memcpy(&first, &one, 1);
  return first == 0;
}

// Unpacks into `to`, whole; false if the packed bytes are damaged or unpack to fewer.
bool unpack(const std::vector<char>& packed, std::vector<char>& to)
{
  z_stream stream{};
  if (inflateInit2(&stream, DetectZlibOrGzip) != Z_OK)
  {
    return false;
  }
  // zlib counts in 32 bits, so both sides go in pieces.
  constexpr std::size_t Piece = 1u << 30;
  std::size_t in = 0;
  std::size_t out = 0;
  int status = Z_OK;
  while (status == Z_OK && out < to.size())
  {
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data() + in));
    stream.avail_in = static_cast<uInt>(std::min(Piece, packed.size() - in));
    stream.next_out = reinterpret_cast<Bytef*>(to.data() + out);
    stream.avail_out = static_cast<uInt>(std::min(Piece, to.size() - out));
    const uInt inBefore = stream.avail_in;
    const uInt outBefore = stream.avail_out;
    status = inflate(&stream, Z_NO_FLUSH);
    in += inBefore - stream.avail_in;
    out += outBefore - stream.avail_out;
  }
  if (status == Z_OK) // what follows the numbers is their checksum
  {
    Bytef more = 0;
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data() + in));
    stream.avail_in = static_cast<uInt>(std::min(Piece, packed.size() - in));
    stream.next_out = &more;
    stream.avail_out = 1;
    status = inflate(&stream, Z_NO_FLUSH);
  }
  inflateEnd(&stream);
  return out == to.size() && status != Z_DATA_ERROR;
}

// Why there is too little memory for the field; the end of a sentence, empty if there is enough.
std::string memoryProblemOf(const TextHeader& header, std::size_t storedBytes)
{
  const double bytes = static_cast<double>(header.dataBytes()) +
    static_cast<double>(header.grid.count() * sizeof(glm::vec3)) +
    (header.isPacked ? static_cast<double>(storedBytes) : 0.0);
  const std::string problem = hostMemoryProblem(
    "a field of " + sizeText(glm::dvec3(header.grid.dimensions)) + " points", bytes);
  return problem.empty() ? problem : "cannot be read: " + problem;
}

std::string readData(const std::string& fileName, const TextHeader& header, std::vector<char>& data)
{
  const std::string dataFile = header.dataFile.empty()
    ? fileName
    : (std::filesystem::path(fileName).parent_path() / header.dataFile).string();
  const std::string problem = plainFileProblem(dataFile);
  if (!problem.empty())
  {
    return "names the file " + shownWords(dataFile) + ", which " + problem;
  }
  std::ifstream file(dataFile, std::ios::binary);
  if (!file)
  {
    return "names the file " + shownWords(dataFile) + ", which cannot be opened";
  }
  file.seekg(0, std::ios::end);
  const auto size = static_cast<std::size_t>(file.tellg());
  const std::size_t bytes = size - std::min(header.headerBytes, size);
  if (!header.isPacked && bytes < header.dataBytes())
  {
    return "has " + std::to_string(bytes) + " bytes of numbers where the header announces " +
      std::to_string(header.dataBytes());
  }
  // No stream unpacks to more than some thousand times its size: a damaged header asks for more.
  if (header.isPacked && header.dataBytes() / 1100 > bytes)
  {
    return "has " + std::to_string(bytes) + " packed bytes where the header announces " +
      std::to_string(header.dataBytes()) + " bytes of numbers";
  }
  const std::string tooLarge = memoryProblemOf(header, bytes);
  if (!tooLarge.empty())
  {
    return tooLarge;
  }
  std::vector<char> stored(header.isPacked ? bytes : header.dataBytes());
  file.seekg(static_cast<std::streamoff>(header.headerBytes));
  if (!file.read(stored.data(), static_cast<std::streamsize>(stored.size())))
  {
    return "has only " + std::to_string(file.gcount()) + " readable bytes of numbers";
  }
  if (!header.isPacked)
  {
    data = std::move(stored);
    return {};
  }
  data.resize(header.dataBytes());
  return unpack(stored, data) ? std::string() : "has packed numbers that are damaged or too few";
}

template <typename Number>
void copyNumbers(std::vector<char>& data, bool swap, std::vector<glm::vec3>& vectors)
{
  for (std::size_t i = 0; i < 3 * vectors.size(); ++i)
  {
    char* bytes = data.data() + i * sizeof(Number);
    if (swap)
    {
      std::reverse(bytes, bytes + sizeof(Number));
    }
    Number number;
    std::memcpy(&number, bytes, sizeof(Number));
    vectors[i / 3][static_cast<int>(i % 3)] = static_cast<float>(number);
  }
}

std::string list(const glm::dvec3& numbers, const char* between)
{
  std::ostringstream text;
  text.precision(17);
  text << numbers.x << between << numbers.y << between << numbers.z;
  return text.str();
}

const char* byteOrder()
{
  return thisMachineIsBigEndian() ? "big" : "little";
}

std::string write(
  const std::string& fileName, const std::string& header, const DirectedField& field)
{
  return writeWhole(fileName, [&](const std::string& beside) {
    errno = 0;
    std::ofstream file(beside, std::ios::binary);
    file << header;
    file.write(reinterpret_cast<const char*>(field.displacements.data()),
      static_cast<std::streamsize>(field.displacements.size() * sizeof(glm::vec3)));
    file.close();
    return file ? std::string() : lastSystemError();
  });
}
}

bool isTextHeaderField(const std::string& fileName)
{
  TextHeader header;
  return readTextHeader(fileName, header).empty();
}

std::string readTextHeaderField(const std::string& fileName, DirectedField& field)
{
  TextHeader header;
  std::vector<char> data;
  std::string problem = readTextHeader(fileName, header);
  problem = problem.empty() ? readData(fileName, header, data) : problem;
  if (!problem.empty())
  {
    return "File " + fileName + " " + problem;
  }
  field.grid = header.grid;
  field.direction = header.direction;
  field.displacements.resize(header.grid.count());
  const bool swap = header.isBigEndian != thisMachineIsBigEndian();
  if (header.isDouble)
  {
    copyNumbers<double>(data, swap, field.displacements);
  }
  else
  {
    copyNumbers<float>(data, swap, field.displacements);
  }
  reverseXY(field);
  return {};
}

std::string writeMetaImageField(const std::string& fileName, const DirectedField& ras)
{
  DirectedField field = ras;
  reverseXY(field);
  const Grid& grid = field.grid;
  std::ostringstream header;
  header << "ObjectType = Image\nNDims = 3\n"
         << "Comment = "
         << (field.direction == Direction::Forward ? ForwardComment : BackwardComment) << "\n"
         << "BinaryData = True\nBinaryDataByteOrderMSB = "
         << (thisMachineIsBigEndian() ? "True" : "False") << "\nCompressedData = False\n"
         << "TransformMatrix = " << list(grid.direction[0], " ") << " "
         << list(grid.direction[1], " ") << " " << list(grid.direction[2], " ") << "\n"
         << "Offset = " << list(grid.origin, " ") << "\nCenterOfRotation = 0 0 0\n"
         << "ElementSpacing = " << list(grid.spacing, " ") << "\n"
         << "DimSize = " << list(glm::dvec3(grid.dimensions), " ") << "\n"
         << "ElementNumberOfChannels = 3\nElementType = MET_FLOAT\nElementDataFile = LOCAL\n";
  return write(fileName, header.str(), field);
}

std::string writeNRRDField(const std::string& fileName, const DirectedField& ras)
{
  DirectedField field = ras;
  reverseXY(field);
  const Grid& grid = field.grid;
  std::ostringstream header;
  header << "NRRD0005\ntype: float\ndimension: 4\nspace: left-posterior-superior\n"
         << "sizes: 3 " << list(glm::dvec3(grid.dimensions), " ") << "\nspace directions: none";
  for (int axis = 0; axis < 3; ++axis)
  {
    header << " (" << list(grid.direction[axis] * grid.spacing[axis], ",") << ")";
  }
  header << "\nkinds: vector domain domain domain\nendian: " << byteOrder()
         << "\nencoding: raw\nspace origin: (" << list(grid.origin, ",") << ")\n"
         << "displacement field type:="
         << (field.direction == Direction::Forward ? "modeling" : "resampling") << "\n\n";
  return write(fileName, header.str(), field);
}
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Common/Bytes.h"
#include "Common/HostMemory.h"
#include "Common/Numbers.h"
#include "Formats/Files/Text.h"
#include "Formats/GIFTI/GIFTIFile.h"

#include "vtk_zlib.h"

namespace brainshift
{
namespace
{
constexpr double LargestDeflateRatio = 1100.0; // no zlib stream unpacks to more times its size
constexpr int MostDimensions = 6;              // as the format has it
constexpr double MostRows = 2147483647.0;      // indices of points are 32-bit integers

const std::map<std::string, NumberType> Types{
  { "NIFTI_TYPE_UINT8", NumberType::UInt8 },
  { "NIFTI_TYPE_INT32", NumberType::Int32 },
  { "NIFTI_TYPE_FLOAT32", NumberType::Float32 },
  { "NIFTI_TYPE_FLOAT64", NumberType::Float64 },
};

// The value of a letter of base64; -1 for a space, -2 for all others.
std::array<int, 256> lettersOfBase64()
{
  constexpr std::string_view Letters =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::array<int, 256> values;
  values.fill(-2);
  for (const char space : { ' ', '\t', '\r', '\n' })
  {
    values[static_cast<unsigned char>(space)] = -1;
  }
  for (std::size_t i = 0; i < Letters.size(); ++i)
  {
    values[static_cast<unsigned char>(Letters[i])] = static_cast<int>(i);
  }
  return values;
}

// None if the text is no base64. What follows the first "=" must be "=" or space.
std::optional<std::vector<char>> fromBase64(const std::string& text)
{
  static const std::array<int, 256> Values = lettersOfBase64();
  std::vector<char> bytes;
  bytes.reserve(text.size() / 4 * 3 + 3);
  std::uint32_t bits = 0;
  int count = 0; // bits that are waiting
  std::size_t i = 0;
  for (; i < text.size() && text[i] != '='; ++i)
  {
    const int value = Values[static_cast<unsigned char>(text[i])];
    if (value == -2)
    {
      return std::nullopt;
    }
    if (value >= 0)
    {
      bits = (bits << 6) | static_cast<std::uint32_t>(value);
      count += 6;
    }
    if (count >= 8)
    {
      count -= 8;
      bytes.push_back(static_cast<char>((bits >> count) & 0xFF));
    }
  }
  const bool isEnd = std::all_of(text.begin() + static_cast<std::ptrdiff_t>(i), text.end(),
    [](char letter) { return letter == '=' || Values[static_cast<unsigned char>(letter)] == -1; });
  return isEnd ? std::optional(std::move(bytes)) : std::nullopt;
}

template <typename T>
void readASCII(const std::string& text, std::vector<char>& bytes)
{
  constexpr std::string_view Blanks = " \t\r\n";
  using Stored = std::conditional_t<std::is_floating_point_v<T>, double, T>;
  std::string_view rest(text);
  const std::size_t wanted = bytes.size() / sizeof(T);
  std::size_t count = 0;
  while (true)
  {
    rest.remove_prefix(std::min(rest.find_first_not_of(Blanks), rest.size()));
    if (rest.empty())
    {
      break;
    }
    const auto found = takeNumber<Stored>(rest);
    if (!found)
    {
      const std::string word(rest.substr(0, 40));
      throw Problem("has \"" + shownWords(word.substr(0, word.find_first_of(Blanks))) +
        "\" in place of a number");
    }
    const auto number = static_cast<T>(*found);
    if (count < wanted)
    {
      std::memcpy(&bytes[count * sizeof(T)], &number, sizeof(T));
    }
    ++count;
  }
  if (count != wanted)
  {
    throw Problem("has " + std::to_string(count) + " numbers; its dimensions announce " +
      std::to_string(wanted));
  }
}

void readASCIIOf(NumberType type, const std::string& text, std::vector<char>& bytes)
{
  switch (type)
  {
    case NumberType::UInt8:
      readASCII<unsigned char>(text, bytes);
      return;
    case NumberType::Int32:
      readASCII<std::int32_t>(text, bytes);
      return;
    case NumberType::Float64:
      readASCII<double>(text, bytes);
      return;
    default:
      readASCII<float>(text, bytes);
      return;
  }
}

Problem fewerBytes(std::size_t found, std::size_t wanted)
{
  return Problem(
    "has " + std::to_string(found) + " bytes; its dimensions announce " + std::to_string(wanted));
}

// Fills `bytes`, whose size is what the dimensions announce.
void readBase64(const std::string& text, bool isPacked, std::vector<char>& bytes)
{
  const std::optional<std::vector<char>> stored = fromBase64(text);
  if (!stored)
  {
    throw Problem("has letters that are no base64");
  }
  if (!isPacked)
  {
    if (stored->size() != bytes.size())
    {
      throw fewerBytes(stored->size(), bytes.size());
    }
    std::copy(stored->begin(), stored->end(), bytes.begin());
    return;
  }
  uLongf size = static_cast<uLongf>(bytes.size());
  const int status = uncompress(reinterpret_cast<Bytef*>(bytes.data()), &size,
    reinterpret_cast<const Bytef*>(stored->data()), static_cast<uLong>(stored->size()));
  if (status == Z_OK && size != bytes.size())
  {
    throw fewerBytes(size, bytes.size());
  }
  if (status != Z_OK)
  {
    throw Problem("has packed numbers that are damaged, too few or too many");
  }
}

// Columns of the file become rows, as they are in memory.
void transpose(GIFTIArray& array)
{
  const std::size_t size = bytesOf(array.type);
  const std::vector<char> stored = array.bytes;
  for (std::size_t row = 0; row < array.rows; ++row)
  {
    for (std::size_t column = 0; column < array.columns; ++column)
    {
      std::memcpy(&array.bytes[(row * array.columns + column) * size],
        &stored[(column * array.rows + row) * size], size);
    }
  }
}

void readDimensions(GIFTIArray& array)
{
  const std::string said = array.attribute("Dimensionality");
  const std::vector<double> dimensions = numbersIn(said);
  if (dimensions.size() != 1 || !isWhole(dimensions[0], 1, MostDimensions))
  {
    throw Problem("has the Dimensionality \"" + shownWords(said) + "\"; it must be 1 to 6");
  }
  double columns = 1.0;
  for (int i = 0; i < static_cast<int>(dimensions[0]); ++i)
  {
    const std::string name = "Dim" + std::to_string(i);
    const std::vector<double> side = numbersIn(array.attribute(name));
    if (side.size() != 1 || !isWhole(side[0], 1, MostRows))
    {
      throw Problem("has the " + name + " \"" + shownWords(array.attribute(name)) +
        "\"; it must be 1 to 2147483647");
    }
    columns *= i == 0 ? 1.0 : side[0];
    array.rows = i == 0 ? static_cast<std::size_t>(side[0]) : array.rows;
  }
  array.columns = static_cast<std::size_t>(std::min(columns, MostRows));
  if (!(columns <= MostRows))
  {
    throw Problem("has more than 2147483647 numbers in a row");
  }
}

// Throws if the numbers cannot be in the text, or in memory.
void requireSize(const GIFTIArray& array, const std::string& encoding, std::size_t letters)
{
  const double numbers = static_cast<double>(array.rows) * static_cast<double>(array.columns);
  const double bytes = numbers * static_cast<double>(bytesOf(array.type));
  const auto length = static_cast<double>(letters);
  const double most = encoding == "ASCII" ? (length + 1.0) / 2.0 * bytes / numbers
    : encoding == "Base64Binary"          ? length
                                          : length * LargestDeflateRatio;
  if (bytes > most)
  {
    throw Problem("has " + std::to_string(letters) +
      " letters of numbers; its dimensions announce " +
      std::to_string(static_cast<std::uint64_t>(numbers)) + " numbers");
  }
  requireHostMemory("it", bytes);
}
}

void readGIFTINumbers(const std::string& text, GIFTIArray& array)
{
  const auto type = Types.find(array.attribute("DataType"));
  if (type == Types.end())
  {
    throw Problem("has the DataType \"" + shownWords(array.attribute("DataType")) +
      "\"; BrainShift reads NIFTI_TYPE_UINT8, INT32, FLOAT32 and FLOAT64");
  }
  array.type = type->second;
  const std::string encoding = array.attribute("Encoding");
  const bool isASCII = encoding == "ASCII";
  const bool isPacked = encoding == "GZipBase64Binary";
  if (!isASCII && !isPacked && encoding != "Base64Binary")
  {
    throw Problem("has the Encoding \"" + shownWords(encoding) +
      "\"; BrainShift reads ASCII, Base64Binary and GZipBase64Binary");
  }
  const std::string endian = array.attribute("Endian");
  if (!isASCII && endian != "BigEndian" && endian != "LittleEndian")
  {
    throw Problem(
      "has the Endian \"" + shownWords(endian) + "\"; it must be BigEndian or LittleEndian");
  }
  readDimensions(array);
  requireSize(array, encoding, text.size());
  array.bytes.resize(array.rows * array.columns * bytesOf(array.type));
  if (isASCII)
  {
    readASCIIOf(array.type, text, array.bytes);
  }
  else
  {
    readBase64(text, isPacked, array.bytes);
  }

  if (!isASCII)
  {
    toMachineOrder(
      array.bytes.data(), array.rows * array.columns, bytesOf(array.type), endian == "BigEndian");
  }
  const std::string order = array.attribute("ArrayIndexingOrder");
  if (order == "ColumnMajorOrder")
  {
    transpose(array);
  }
  if (!(order == "ColumnMajorOrder" || order == "RowMajorOrder"))
  {
    throw Problem("has the ArrayIndexingOrder \"" + shownWords(order) +
      "\"; it must be RowMajorOrder or ColumnMajorOrder");
  }
}
}

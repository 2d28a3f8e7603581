// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/NIFTI/NIFTILabels.h"

#include "Common/Bytes.h"
#include "Common/Numbers.h"
#include "Formats/Files/PackedBytes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace brainshift
{
namespace
{
constexpr std::int32_t WorkbenchCode = 30; // NIFTI_ECODE_CARET
constexpr std::int32_t LongestExtension = 1 << 24;
constexpr int MostExtensions = 100;
constexpr std::size_t MostLabels = 65536;

// Some bytes of a file that may be packed. False if they are not there.
bool bytesAt(
  const std::string& fileName, std::uint64_t place, std::size_t count, std::string& bytes)
{
  const bool isPacked = beginsLikeGzip(fileName);
  const StoredBytes from{ fileName, isPacked ? 0 : place, isPacked, isPacked ? place : 0 };
  if (!bytesProblem(from, static_cast<double>(count)).empty())
  {
    return false;
  }
  bytes.assign(count, '\0');
  return readBytes(from, &bytes[0], count, [](double) { return true; }).empty();
}

// The text of the first extension with the code; empty if there is none.
std::string extensionOf(const std::string& fileName)
{
  std::string bytes;
  if (!bytesAt(fileName, 0, 4, bytes))
  {
    return {};
  }
  const auto isHeader = [](std::int32_t size) { return size == 348 || size == 540; };
  const bool isBigEndian = !isHeader(storedNumber<std::int32_t>(bytes.data(), false));
  const std::int32_t headerBytes = storedNumber<std::int32_t>(bytes.data(), isBigEndian);
  if (!isHeader(headerBytes) ||
    !bytesAt(fileName, static_cast<std::uint64_t>(headerBytes), 4, bytes) || bytes[0] == 0)
  {
    return {};
  }
  std::uint64_t place = static_cast<std::uint64_t>(headerBytes) + 4;
  for (int i = 0; i < MostExtensions && bytesAt(fileName, place, 8, bytes); ++i)
  {
    const std::int32_t size = storedNumber<std::int32_t>(bytes.data(), isBigEndian);
    if (size < 16 || size > LongestExtension || size % 16 != 0)
    {
      return {};
    }
    if (storedNumber<std::int32_t>(bytes.data() + 4, isBigEndian) == WorkbenchCode)
    {
      return bytesAt(fileName, place + 8, static_cast<std::size_t>(size) - 8, bytes)
        ? bytes
        : std::string();
    }
    place += static_cast<std::uint64_t>(size);
  }
  return {};
}

// The number of an attribute; NaN if the element has none.
double attribute(const std::string& element, const std::string& name)
{
  const std::string key = " " + name + "=\"";
  const std::size_t begin = element.find(key);
  const std::size_t end =
    begin == std::string::npos ? begin : element.find('"', begin + key.size());
  const std::vector<double> numbers = end == std::string::npos
    ? std::vector<double>()
    : numbersIn(element.substr(begin + key.size(), end - begin - key.size()));
  return numbers.size() == 1 ? numbers[0] : std::nan("");
}

// What stands between the tags, with or without CDATA.
std::string contentOf(std::string text)
{
  const std::string open = "<![CDATA[";
  const std::size_t begin = text.find(open);
  if (begin != std::string::npos)
  {
    text.erase(0, begin + open.size());
    text.erase(std::min(text.find("]]>"), text.size()));
  }
  return text;
}
}

std::vector<Label> niftiLabels(const std::string& fileName)
{
  const std::string text = extensionOf(fileName);
  const std::string close = "</Label>";
  std::vector<Label> labels;
  for (std::size_t place = text.find("<Label "); place != std::string::npos;
    place = text.find("<Label ", place + 1))
  {
    const std::size_t middle = text.find('>', place);
    const std::size_t end = text.find(close, place);
    if (middle == std::string::npos || end == std::string::npos || middle > end ||
      labels.size() == MostLabels)
    {
      break;
    }
    const std::string element = text.substr(place, middle - place);
    const double key = attribute(element, "Key");
    if (!isWhole(key, std::numeric_limits<int>::min(), std::numeric_limits<int>::max()))
    {
      continue;
    }
    Label label;
    label.value = static_cast<int>(key);
    label.name = contentOf(text.substr(middle + 1, end - middle - 1));
    const std::array<const char*, 3> names{ "Red", "Green", "Blue" };
    for (std::size_t i = 0; i < names.size(); ++i)
    {
      const double share = attribute(element, names[i]);
      label.color[i] = share >= 0.0
        ? static_cast<unsigned char>(std::lround(255.0 * std::min(share, 1.0)))
        : label.color[i];
    }
    labels.push_back(label);
  }
  return labels;
}
}

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Words of text headers that stand for lengths and times, and the times of an axis.
#include "Formats/Files/Text.h"
#include "Formats/TextHeaders/TextHeader.h"
#include "Formats/Volumes/VolumeFile.h"

#include <algorithm>
#include <cmath>

namespace brainshift
{
namespace
{
constexpr const char* MicroSign = "\xc2\xb5"; // U+00B5
constexpr const char* GreekMu = "\xce\xbc";   // U+03BC

// In small letters, with u for micro.
std::string plainUnit(const std::string& word)
{
  std::string plain = lowerCase(trimmed(word));
  for (const char* micro : { MicroSign, GreekMu, "\xce\x9c" }) // the last: a capital Mu
  {
    const std::size_t place = plain.find(micro);
    plain = place == std::string::npos ? plain : plain.replace(place, 2, "u");
  }
  return plain;
}

std::optional<double> factorOf(
  const std::map<std::string, double>& factors, const std::string& word)
{
  const std::string plain = plainUnit(word);
  auto known = factors.find(plain);
  // A plural of a word, not of a sign: there is no unit "mms".
  if (known == factors.end() && plain.size() > 3 && plain.back() == 's')
  {
    known = factors.find(plain.substr(0, plain.size() - 1));
  }
  return known == factors.end() ? std::nullopt : std::optional<double>(known->second);
}

const std::map<std::string, double> MmPerUnit{ { "", 1.0 }, { "mm", 1.0 }, { "millimeter", 1.0 },
  { "millimetre", 1.0 }, { "cm", 10.0 }, { "centimeter", 10.0 }, { "centimetre", 10.0 },
  { "m", 1e3 }, { "meter", 1e3 }, { "metre", 1e3 }, { "km", 1e6 }, { "um", 1e-3 },
  { "micron", 1e-3 }, { "micrometer", 1e-3 }, { "micrometre", 1e-3 }, { "nm", 1e-6 },
  { "nanometer", 1e-6 }, { "nanometre", 1e-6 }, { "in", 25.4 }, { "inch", 25.4 },
  { "inches", 25.4 }, { "ft", 304.8 }, { "foot", 304.8 }, { "feet", 304.8 } };

const std::map<std::string, double> SecondsPerUnit{ { "", 1.0 }, { "s", 1.0 }, { "sec", 1.0 },
  { "second", 1.0 }, { "ms", 1e-3 }, { "msec", 1e-3 }, { "millisecond", 1e-3 }, { "us", 1e-6 },
  { "usec", 1e-6 }, { "microsecond", 1e-6 }, { "ns", 1e-9 }, { "nanosecond", 1e-9 },
  { "min", 60.0 }, { "minute", 60.0 }, { "h", 3600.0 }, { "hr", 3600.0 }, { "hour", 3600.0 } };

bool grows(const std::vector<double>& times)
{
  return std::all_of(times.begin(), times.end(), [](double time) { return std::isfinite(time); }) &&
    std::adjacent_find(times.begin(), times.end(), std::greater_equal<double>()) == times.end();
}
}

std::optional<double> mmPerUnit(const std::string& word)
{
  return factorOf(MmPerUnit, word);
}

std::vector<double> timesOf(const HeaderAxis& axis, std::vector<std::string>& warnings)
{
  const auto count = static_cast<std::size_t>(axis.count);
  const std::optional<double> seconds = factorOf(SecondsPerUnit, axis.unit);
  const std::string numbered = "; its volumes are numbered 0, 1, 2 and so on";
  if (count > 1 && !seconds)
  {
    warnings.push_back("has an axis of volumes in the unit '" + shownWords(axis.unit) +
      "', which is none of time" + numbered);
    return evenTimes(count, 1.0);
  }
  if (count > 1 && !axis.values.empty())
  {
    std::vector<double> times = axis.values;
    std::for_each(times.begin(), times.end(), [&](double& time) { time *= *seconds; });
    if (times.size() == count && grows(times))
    {
      return times;
    }
    warnings.push_back("has index values of an axis of volumes that are not " +
      std::to_string(count) + " growing numbers" + numbered);
    return evenTimes(count, 1.0);
  }
  if (count > 1 && axis.spacing && !(*axis.spacing > 0.0 && std::isfinite(*axis.spacing)))
  {
    warnings.push_back(joined("has the time step ", *axis.spacing, ", which is none", numbered));
    return evenTimes(count, 1.0);
  }
  if (count > 1 && axis.spacing && seconds)
  {
    return evenTimes(count, *seconds * *axis.spacing, *seconds * axis.start);
  }
  return evenTimes(count, 1.0);
}
}

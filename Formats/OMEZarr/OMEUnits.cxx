// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/OMEZarr/OMEUnits.h"

#include <map>

namespace brainshift
{
namespace
{
// The factor of a unit such as "micrometer": that of its prefix. `base` is "meter" or "second".
std::optional<double> prefixOf(const std::string& unit, const std::string& base)
{
  static const std::map<std::string, double> prefixes{ { "yocto", 1e-24 }, { "zepto", 1e-21 },
    { "atto", 1e-18 }, { "femto", 1e-15 }, { "pico", 1e-12 }, { "nano", 1e-9 }, { "micro", 1e-6 },
    { "milli", 1e-3 }, { "centi", 1e-2 }, { "deci", 1e-1 }, { "", 1.0 }, { "hecto", 1e2 },
    { "kilo", 1e3 }, { "mega", 1e6 }, { "giga", 1e9 }, { "tera", 1e12 }, { "peta", 1e15 },
    { "exa", 1e18 }, { "zetta", 1e21 }, { "yotta", 1e24 } };
  if (unit.size() < base.size() || unit.substr(unit.size() - base.size()) != base)
  {
    return std::nullopt;
  }
  const auto found = prefixes.find(unit.substr(0, unit.size() - base.size()));
  return found == prefixes.end() ? std::nullopt : std::optional<double>(found->second);
}

std::optional<double> unitIn(const std::map<std::string, double>& others, const std::string& unit,
  const std::string& base, double ofBase)
{
  const auto found = others.find(unit);
  const std::optional<double> prefix = prefixOf(unit, base);
  return found != others.end() ? std::optional<double>(found->second)
    : prefix                   ? std::optional<double>(*prefix * ofBase)
                               : std::nullopt;
}
}

std::optional<double> millimetresIn(const std::string& unit)
{
  // Those that are most in use are exact: 1e-6 * 1e3 is not 1e-3 in every digit.
  static const std::map<std::string, double> others{ { "angstrom", 1e-7 }, { "nanometer", 1e-6 },
    { "micrometer", 1e-3 }, { "millimeter", 1.0 }, { "centimeter", 10.0 }, { "decimeter", 100.0 },
    { "foot", 304.8 }, { "inch", 25.4 }, { "mile", 1609344.0 }, { "parsec", 3.0856775814913673e19 },
    { "yard", 914.4 } };
  return unitIn(others, unit, "meter", 1e3);
}

std::optional<double> secondsIn(const std::string& unit)
{
  static const std::map<std::string, double> others{ { "day", 86400.0 }, { "hour", 3600.0 },
    { "minute", 60.0 } };
  return unitIn(others, unit, "second", 1.0);
}
}

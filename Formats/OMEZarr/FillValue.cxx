// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The number that stands for chunks that are not there.
#include "Common/Numbers.h"
#include "Common/Problem.h"
#include "Formats/OMEZarr/ZarrArray.h"

#include "vtkSetGet.h" // for the macro that visits types

#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

namespace brainshift
{
namespace
{
[[noreturn]] void failFill(const Json& json)
{
  throw Problem("has the fill_value " + shownJson(json) + ", which its data type cannot hold");
}

// Of a JSON integer. The limits of all types but uint64 are within those of int64.
template <typename T>
T wholeFill(const Json& json)
{
  if (json.is_number_unsigned())
  {
    const auto number = json.get<std::uint64_t>();
    return number <= static_cast<std::uint64_t>(std::numeric_limits<T>::max())
      ? static_cast<T>(number)
      : (failFill(json), T());
  }
  if (json.is_number_integer())
  {
    const auto number = json.get<std::int64_t>(); // it is negative
    return std::is_signed_v<T> &&
        number >= static_cast<std::int64_t>(std::numeric_limits<T>::lowest())
      ? static_cast<T>(number)
      : (failFill(json), T());
  }
  constexpr double Exact = 9007199254740992.0; // 2^53
  const double number = json.is_number() ? json.get<double>() : std::nan("");
  const bool holds = isWhole(number, -Exact, Exact) &&
    number >= static_cast<double>(std::numeric_limits<T>::lowest()) &&
    number <= static_cast<double>(std::numeric_limits<T>::max());
  return holds ? static_cast<T>(number) : (failFill(json), T());
}

// A number, one of three words, or the bits of the number as "0x7fc00000".
template <typename T>
T realFill(const Json& json)
{
  using Bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
  const std::string text = textIn(json);
  if (text == "NaN")
  {
    return std::numeric_limits<T>::quiet_NaN();
  }
  if (text == "Infinity" || text == "-Infinity")
  {
    return text.front() == '-' ? -std::numeric_limits<T>::infinity()
                               : std::numeric_limits<T>::infinity();
  }
  if (text.size() == 2 + 2 * sizeof(T) && text.rfind("0x", 0) == 0)
  {
    Bits bits = 0;
    const char* const end = text.data() + text.size();
    if (std::from_chars(text.data() + 2, end, bits, 16).ptr == end)
    {
      T number;
      std::memcpy(&number, &bits, sizeof(T));
      return number;
    }
  }
  const double number = json.is_number() ? json.get<double>() : (failFill(json), 0.0);
  return std::abs(number) <= static_cast<double>(std::numeric_limits<T>::max())
    ? static_cast<T>(number)
    : (failFill(json), T());
}

template <typename T>
std::string bytesOf(const Json& json)
{
  T number{};
  if constexpr (std::is_floating_point_v<T>)
  {
    number = realFill<T>(json);
  }
  else
  {
    number = wholeFill<T>(json);
  }
  return std::string(reinterpret_cast<const char*>(&number), sizeof(T));
}
}

std::string fillBytes(const Json& json, const ZarrType& type)
{
  if (json.is_null()) // of version 2: what is there does not matter
  {
    return std::string(type.bytes, '\0');
  }
  if (type.isBoolean)
  {
    throwIfAny(json.is_boolean() || json == Json(0) || json == Json(1)
        ? ""
        : "has the fill_value " + shownJson(json) + ", which its data type cannot hold");
    return std::string(1, json == Json(true) || json == Json(1) ? '\1' : '\0');
  }
  std::string bytes;
  switch (type.vtkType)
  {
    vtkTemplateMacro(bytes = bytesOf<VTK_TT>(json));
  }
  return bytes;
}
}

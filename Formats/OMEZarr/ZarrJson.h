// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The JSON of a zarr store, of which nothing is believed before it is looked at.
///
/// Faults are thrown as a Problem: the end of a sentence about the entry.
#ifndef BrainShift_ZarrJson_h
#define BrainShift_ZarrJson_h

#include "Formats/OMEZarr/ZarrStore.h"

#include "vtk_nlohmannjson.h"
#include VTK_NLOHMANN_JSON(json.hpp)

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace brainshift
{
using Json = nlohmann::json;

/** The JSON of an entry, an object; none if the entry is not there. Up to 16 MiB, 64 deep. */
std::optional<Json> readJson(const ZarrStore& store, const std::string& key);

/** A member of an object; null if it is not there, or if `object` is none. */
const Json& memberOf(const Json& object, const char* name);

/** A text; `otherwise` if it is none. */
std::string textIn(const Json& json, const std::string& otherwise = {});

/** What a sentence may show of a value. */
std::string shownJson(const Json& json);

/**
 * Whole numbers from `least` to 2^53.
 *
 * @param count   how many they must be; 0: any number from 1 to 32
 * @param name    of the list, in a sentence
 */
std::vector<std::int64_t> wholeNumbersIn(
  const Json& json, std::size_t count, std::int64_t least, const std::string& name);

/** Some finite numbers. */
std::vector<double> realNumbersIn(const Json& json, std::size_t count, const std::string& name);
}

#endif

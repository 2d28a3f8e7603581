// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/OMEZarr/ZarrArray.h"

#include "Common/Bytes.h"
#include "Common/Problem.h"
#include "Formats/Files/Text.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>

namespace brainshift
{
namespace
{
constexpr double MostChunkBytes = 2147483647.0; // of blosc

// Types by the names of version 3. The letters of version 2 lead to them.
const std::map<std::string, ZarrType> Types{ { "bool", { VTK_TYPE_UINT8, 1, true } },
  { "int8", { VTK_TYPE_INT8, 1 } }, { "int16", { VTK_TYPE_INT16, 2 } },
  { "int32", { VTK_TYPE_INT32, 4 } }, { "int64", { VTK_TYPE_INT64, 8 } },
  { "uint8", { VTK_TYPE_UINT8, 1 } }, { "uint16", { VTK_TYPE_UINT16, 2 } },
  { "uint32", { VTK_TYPE_UINT32, 4 } }, { "uint64", { VTK_TYPE_UINT64, 8 } },
  { "float32", { VTK_FLOAT, 4 } }, { "float64", { VTK_DOUBLE, 8 } } };

ZarrType typeNamed(const std::string& name, const Json& shown)
{
  const auto found = Types.find(name);
  if (found == Types.end())
  {
    throw Problem("has the data type " + shownJson(shown) +
      "; BrainShift reads bool, integers of 8 to 64 bits, float32 and float64");
  }
  return found->second;
}

std::string choiceIn(
  const Json& json, const std::string& name, const std::vector<std::string>& allowed)
{
  const std::string text = textIn(json);
  if (std::find(allowed.begin(), allowed.end(), text) == allowed.end())
  {
    std::string list;
    for (const std::string& one : allowed)
    {
      list += (list.empty() ? "'" : " or '") + one + "'";
    }
    throw Problem("has the " + name + " " + shownJson(json) + "; it must be " + list);
  }
  return text;
}

// A codec, grid or encoding of version 3: a name, and what else its metadata have.
struct Named
{
  std::string name;
  Json configuration;
};

Named namedIn(const Json& json, const std::string& what)
{
  const Json& name = json.is_string() ? json : memberOf(json, "name");
  throwIfAny(name.is_string() ? "" : "has a " + what + " without a name: " + shownJson(json));
  const Json& configuration = memberOf(json, "configuration");
  if (!configuration.is_null() && !configuration.is_object())
  {
    throw Problem("has a " + what + " with the configuration " + shownJson(configuration) +
      "; it must be an object");
  }
  return { name.get<std::string>(), configuration };
}

void requireChunk(const ZarrArray& array)
{
  double bytes = static_cast<double>(array.type.bytes);
  for (const std::int64_t side : array.chunk)
  {
    bytes *= static_cast<double>(side);
  }
  if (bytes > MostChunkBytes)
  {
    throw Problem(joined("has chunks of ", bytes, " bytes; they may have up to ", MostChunkBytes));
  }
}

// ---- Version 2

void takeType2(const Json& json, ZarrArray& array)
{
  const std::map<char, std::string> kinds{ { 'b', "bool" }, { 'i', "int" }, { 'u', "uint" },
    { 'f', "float" } };
  const std::string text = textIn(json);
  const auto kind = text.size() == 3 ? kinds.find(text[1]) : kinds.end();
  std::string name;
  if (kind != kinds.end() && text[2] >= '1' && text[2] <= '8' &&
    std::string("<>|=").find(text[0]) != std::string::npos)
  {
    name = kind->second + (text[1] == 'b' ? "" : std::to_string(8 * (text[2] - '0')));
  }
  array.type = typeNamed(text == "|b1" || name != "bool" ? name : std::string(), json);
  if (array.type.bytes > 1 && text[0] != '<' && text[0] != '>')
  {
    throw Problem("has the data type " + shownJson(json) + ", which names no order of bytes");
  }
  array.isBigEndian = text[0] == '>';
}

void readVersion2(const Json& json, ZarrArray& array)
{
  array.shape = wholeNumbersIn(memberOf(json, "shape"), 0, 1, "shape");
  array.chunk = wholeNumbersIn(memberOf(json, "chunks"), array.shape.size(), 1, "chunks");
  takeType2(memberOf(json, "dtype"), array);
  const Json& filters = memberOf(json, "filters");
  throwIfAny(filters.is_null() || (filters.is_array() && filters.empty())
      ? ""
      : "has the filters " + shownJson(filters) + "; BrainShift reads arrays without filters");
  const Json& compressor = memberOf(json, "compressor");
  if (!compressor.is_null())
  {
    addCodec(textIn(memberOf(compressor, "id"), shownJson(compressor)), array.codecs);
  }
  array.order.resize(array.shape.size());
  std::iota(array.order.begin(), array.order.end(), 0);
  if (choiceIn(memberOf(json, "order"), "order", { "C", "F" }) == "F")
  {
    std::reverse(array.order.begin(), array.order.end());
  }
  const Json& separator = memberOf(json, "dimension_separator");
  throwIfAny(json.contains("fill_value") ? "" : "has no fill_value");
  array.separator =
    separator.is_null() ? "." : choiceIn(separator, "dimension_separator", { ".", "/" });
  array.fill = fillBytes(memberOf(json, "fill_value"), array.type);
}

// ---- Version 3

// What is not known may change the meaning of the rest, unless it says that it does not.
void requireKnown(const Json& json)
{
  const std::vector<std::string> known{ "zarr_format", "node_type", "shape", "data_type",
    "chunk_grid", "chunk_key_encoding", "fill_value", "codecs", "attributes", "dimension_names",
    "storage_transformers" };
  for (const auto& [name, value] : json.items())
  {
    const Json& must = memberOf(value, "must_understand");
    if (std::find(known.begin(), known.end(), name) == known.end() &&
      !(must.is_boolean() && !must.get<bool>()))
    {
      throw Problem("has metadata '" + shownWords(name) + "' that BrainShift does not know");
    }
  }
  const Json& transformers = memberOf(json, "storage_transformers");
  throwIfAny(
    transformers.empty() ? "" : "has storage_transformers, which BrainShift does not know");
}

// Whether the bytes of numbers are in the order of big-endian machines.
bool isBigEndian(const Named& codec, std::size_t bytesOfNumber)
{
  const Json& endian = memberOf(codec.configuration, "endian");
  return !(endian.is_null() && bytesOfNumber == 1) &&
    choiceIn(endian, "endian", { "little", "big" }) == "big";
}

void transpose(const Named& codec, ZarrArray& array)
{
  const std::vector<std::int64_t> axes = wholeNumbersIn(
    memberOf(codec.configuration, "order"), array.order.size(), 0, "transpose order");
  std::vector<int> order;
  for (const std::int64_t axis : axes)
  {
    const bool isThere = axis < static_cast<std::int64_t>(array.order.size());
    order.push_back(isThere ? array.order[static_cast<std::size_t>(axis)] : -1);
  }
  if (!std::is_permutation(order.begin(), order.end(), array.order.begin()))
  {
    throw Problem("has the transpose order " + shownJson(memberOf(codec.configuration, "order")) +
      "; it must name each axis once");
  }
  array.order = order;
}

void takeIndexCodecs(const Json& json, ZarrShards& shards)
{
  constexpr std::size_t NumberBytes = 8;
  const std::size_t count = json.is_array() ? json.size() : 0;
  const Named first = count > 0 ? namedIn(json[0], "codec") : Named();
  const Named second = count > 1 ? namedIn(json[1], "codec") : Named();
  if (first.name != "bytes" || count > 2 || (count == 2 && second.name != "crc32c"))
  {
    throw Problem("has the index_codecs " + shownJson(json) +
      "; BrainShift reads bytes, with crc32c after it or not");
  }
  shards.indexIsBigEndian = isBigEndian(first, NumberBytes);
  shards.indexHasChecksum = count == 2;
}

void takeCodecs(const Json& json, ZarrArray& array);

void takeShards(const Named& codec, ZarrArray& array)
{
  throwIfAny(array.hasShards() ? "has shards in shards, which BrainShift does not read" : "");
  ZarrShards shards;
  shards.shape = array.chunk;
  array.chunk = wholeNumbersIn(
    memberOf(codec.configuration, "chunk_shape"), array.shape.size(), 1, "chunk_shape of shards");
  for (std::size_t axis = 0; axis < array.chunk.size(); ++axis)
  {
    if (shards.shape[axis] % array.chunk[axis] != 0)
    {
      throw Problem("has shards of " + std::to_string(shards.shape[axis]) + " numbers along axis " +
        std::to_string(axis) + "; that must be a multiple of its chunks, " +
        std::to_string(array.chunk[axis]));
    }
  }
  const Json& location = memberOf(codec.configuration, "index_location");
  shards.indexIsAtEnd =
    location.is_null() || choiceIn(location, "index_location", { "start", "end" }) == "end";
  takeIndexCodecs(memberOf(codec.configuration, "index_codecs"), shards);
  array.shards = shards;
  takeCodecs(memberOf(codec.configuration, "codecs"), array);
}

void takeCodecs(const Json& json, ZarrArray& array)
{
  bool isBytes = false; // what follows packs bytes
  bool isShards = false;
  for (const Json& entry : json.is_array() ? json : Json::array())
  {
    const Named codec = namedIn(entry, "codec");
    if (isBytes)
    {
      throwIfAny(isShards ? "has shards that are packed, which BrainShift does not read" : "");
      addCodec(codec.name, array.codecs);
    }
    else if (codec.name == "transpose")
    {
      transpose(codec, array);
    }
    else if (codec.name == "sharding_indexed")
    {
      const bool isInOrder = std::is_sorted(array.order.begin(), array.order.end());
      throwIfAny(isInOrder ? "" : "has shards that are transposed, which BrainShift does not read");
      takeShards(codec, array);
      isBytes = isShards = true;
    }
    else if (codec.name == "bytes")
    {
      array.isBigEndian = isBigEndian(codec, array.type.bytes);
      isBytes = true;
    }
    else
    {
      throw Problem("has the codec '" + shownWords(codec.name) +
        "' before bytes; BrainShift reads transpose, bytes and sharding_indexed there");
    }
  }
  throwIfAny(isBytes ? "" : "has the codecs " + shownJson(json) + "; one of them must be bytes");
}

void readVersion3(const Json& json, ZarrArray& array)
{
  choiceIn(memberOf(json, "node_type"), "node_type", { "array" });
  requireKnown(json);
  array.shape = wholeNumbersIn(memberOf(json, "shape"), 0, 1, "shape");
  const Named grid = namedIn(memberOf(json, "chunk_grid"), "chunk_grid");
  throwIfAny(grid.name == "regular"
      ? ""
      : "has the chunk_grid '" + shownWords(grid.name) + "'; BrainShift reads regular");
  array.chunk = wholeNumbersIn(
    memberOf(grid.configuration, "chunk_shape"), array.shape.size(), 1, "chunk_shape");
  array.type = typeNamed(textIn(memberOf(json, "data_type")), memberOf(json, "data_type"));
  const Named keys = namedIn(memberOf(json, "chunk_key_encoding"), "chunk_key_encoding");
  throwIfAny(keys.name == "default" || keys.name == "v2" ? ""
                                                         : "has the chunk_key_encoding '" +
        shownWords(keys.name) + "'; BrainShift reads default and v2");
  const Json& separator = memberOf(keys.configuration, "separator");
  array.prefix = keys.name == "default" ? "c" : "";
  array.separator = !separator.is_null() ? choiceIn(separator, "separator", { ".", "/" })
    : keys.name == "default"             ? "/"
                                         : ".";
  array.order.resize(array.shape.size());
  std::iota(array.order.begin(), array.order.end(), 0);
  takeCodecs(memberOf(json, "codecs"), array);
  throwIfAny(memberOf(json, "fill_value").is_null() ? "has no fill_value" : "");
  array.fill = fillBytes(memberOf(json, "fill_value"), array.type);
}
}

std::size_t ZarrArray::chunkBytes() const
{
  std::size_t bytes = this->type.bytes;
  for (const std::int64_t side : this->chunk)
  {
    bytes *= static_cast<std::size_t>(side);
  }
  return bytes;
}

namespace
{
std::optional<std::int64_t> writtenOf(const ZarrStore& store, const std::string& path)
{
  const std::optional<std::int64_t> written = store.written(keyIn(path, "zarr.json"));
  return written ? written : store.written(keyIn(path, ".zarray"));
}
}

void requireAsRead(const ZarrStore& store, const ZarrArray& array)
{
  throwIfAny(writtenOf(store, array.path) == array.written
      ? std::string()
      : "has an array '" + shownWords(array.path) +
        "' that was written anew, moved or deleted after it was opened; reload it");
}

ZarrArray readZarrArray(const ZarrStore& store, const std::string& path)
{
  ZarrArray array;
  array.path = path;
  std::int64_t version = 3;
  array.written = writtenOf(store, path);
  std::optional<Json> json = readJson(store, keyIn(path, "zarr.json"));
  if (!json)
  {
    version = 2;
    json = readJson(store, keyIn(path, ".zarray"));
  }
  throwIfAny(json ? "" : "has no array '" + shownWords(path) + "': neither zarr.json nor .zarray");
  withBeginning("has an array '" + shownWords(path) + "' that ", [&] {
    if (memberOf(*json, "zarr_format") != Json(version))
    {
      throw Problem("is in the zarr_format " + shownJson(memberOf(*json, "zarr_format")) +
        "; it must be " + std::to_string(version));
    }
    version == 2 ? readVersion2(*json, array) : readVersion3(*json, array);
    requireChunk(array);
  });
  return array;
}
}

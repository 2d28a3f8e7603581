// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/OMEZarr/PyramidPlan.h"

#include "Common/Bytes.h"
#include "Formats/OMEZarr/ChunkWriter.h"

#include "vtkType.h"

#include <algorithm>

namespace brainshift
{
namespace
{
// A number's type: its letter in zarr 2, and its name in zarr 3.
struct TypeNames
{
  std::string letter;
  std::string name;
  int bytes;
};

TypeNames namesOf(int vtkType)
{
  switch (vtkType)
  {
    case VTK_CHAR:
    case VTK_SIGNED_CHAR:
      return { "i", "int", 1 };
    case VTK_UNSIGNED_CHAR:
      return { "u", "uint", 1 };
    case VTK_SHORT:
      return { "i", "int", 2 };
    case VTK_UNSIGNED_SHORT:
      return { "u", "uint", 2 };
    case VTK_INT:
      return { "i", "int", 4 };
    case VTK_UNSIGNED_INT:
      return { "u", "uint", 4 };
    case VTK_FLOAT:
      return { "f", "float", 4 };
    default:
      return { "f", "float", 8 };
  }
}

Json array2(const std::vector<std::int64_t>& shape, const std::vector<std::int64_t>& chunk,
  const TypeNames& type)
{
  const std::string order = type.bytes == 1 ? "|" : thisMachineIsBigEndian() ? ">" : "<";
  return { { "zarr_format", 2 }, { "shape", shape }, { "chunks", chunk },
    { "dtype", order + type.letter + std::to_string(type.bytes) },
    { "compressor",
      { { "id", "blosc" }, { "cname", "zstd" }, { "clevel", ChunkEffort },
        { "shuffle", type.bytes > 1 ? 1 : 0 }, { "blocksize", 0 } } },
    { "fill_value", 0 }, { "order", "C" }, { "filters", nullptr }, { "dimension_separator", "/" } };
}

Json array3(const std::vector<std::int64_t>& shape, const std::vector<std::int64_t>& chunk,
  const TypeNames& type)
{
  const auto named = [](const std::string& name, const Json& configuration) {
    return Json{ { "name", name }, { "configuration", configuration } };
  };
  const Json bytes = named("bytes", { { "endian", thisMachineIsBigEndian() ? "big" : "little" } });
  const Json blosc = named("blosc",
    { { "cname", "zstd" }, { "clevel", ChunkEffort },
      { "shuffle", type.bytes > 1 ? "shuffle" : "noshuffle" }, { "typesize", type.bytes },
      { "blocksize", 0 } });
  return { { "zarr_format", 3 }, { "node_type", "array" }, { "shape", shape },
    { "data_type", type.name + std::to_string(8 * type.bytes) },
    { "chunk_grid", named("regular", { { "chunk_shape", chunk } }) },
    { "chunk_key_encoding", named("default", { { "separator", "/" } }) }, { "fill_value", 0 },
    { "codecs", Json::array({ bytes, blosc }) }, { "attributes", Json::object() } };
}

PyramidFile arrayFile(const PyramidContent& content, const std::string& path,
  const std::vector<std::int64_t>& shape, const std::vector<std::int64_t>& chunk, int type)
{
  return content.isVersion3
    ? PyramidFile{ path + "/zarr.json", array3(shape, chunk, namesOf(type)) }
    : PyramidFile{ path + "/.zarray", array2(shape, chunk, namesOf(type)) };
}

// Numbers for the axes of the arrays: of the channel, if there are several, and of z, y, x.
template <typename Number>
std::vector<Number> inAxes(
  const PyramidContent& content, Number ofChannel, const glm::vec<3, Number>& ofSpace)
{
  std::vector<Number> all{ ofSpace.z, ofSpace.y, ofSpace.x };
  if (content.components > 1)
  {
    all.insert(all.begin(), ofChannel);
  }
  return all;
}

Json axesOf(const PyramidContent& content)
{
  Json axes = Json::array();
  if (content.components > 1)
  {
    axes.push_back({ { "name", "c" }, { "type", "channel" } });
  }
  // Where axes of voxels lead nearly along those of the world, other programs get to know the
  // sides.
  const glm::dmat3& direction = content.grid.direction;
  constexpr double Near = 0.7;
  const bool isUpright = direction[0][0] > Near && direction[1][1] > Near && direction[2][2] > Near;
  for (const auto& [name, leads] : { std::pair{ "z", "inferior-to-superior" },
         std::pair{ "y", "posterior-to-anterior" }, std::pair{ "x", "left-to-right" } })
  {
    axes.push_back({ { "name", name }, { "type", "space" }, { "unit", "millimeter" } });
    if (content.knowsSides && isUpright)
    {
      axes.back()["orientation"] = { { "type", "anatomical" }, { "value", leads } };
    }
  }
  return axes;
}

// Where levels are, as if the axes of the voxels were those of the world.
Json datasetsOf(const PyramidContent& content, const std::vector<PyramidLevel>& levels)
{
  Json datasets = Json::array();
  for (std::size_t i = 0; i < levels.size(); ++i)
  {
    const glm::dvec3 step(levels[i].step);
    const glm::dvec3 scale = step * content.grid.spacing;
    const glm::dvec3 first = content.grid.origin + 0.5 * (step - 1.0) * content.grid.spacing;
    datasets.push_back({ { "path", std::to_string(i) },
      { "coordinateTransformations",
        Json::array({ { { "type", "scale" }, { "scale", inAxes(content, 1.0, scale) } },
          { { "type", "translation" }, { "translation", inAxes(content, 0.0, first) } } }) } });
  }
  return datasets;
}

Json ownOf(const PyramidContent& content, const std::vector<PyramidLevel>& levels)
{
  Json own = { { "version", 1 }, { "bricks", Json::array() } };
  if (content.knowsSides)
  {
    own["world"] = "RAS";
  }
  if (content.grid.direction != glm::dmat3(1.0))
  {
    Json rows = Json::array();
    for (int row = 0; row < 3; ++row)
    {
      rows.push_back({ content.grid.direction[0][row], content.grid.direction[1][row],
        content.grid.direction[2][row] });
    }
    own["direction"] = rows;
  }
  for (std::size_t i = 0; i < levels.size(); ++i)
  {
    own["bricks"].push_back("bricks/" + std::to_string(i));
  }
  return own;
}

Json labelsOf(const PyramidContent& content, const std::string& version)
{
  Json colors = Json::array();
  Json properties = Json::array();
  for (const Label& label : content.labels)
  {
    colors.push_back({ { "label-value", label.value },
      { "rgba", { label.color[0], label.color[1], label.color[2], 255 } } });
    properties.push_back({ { "label-value", label.value }, { "name", label.name } });
  }
  return { { "version", version }, { "colors", colors }, { "properties", properties } };
}

Json channelsOf(const PyramidContent& content)
{
  Json channels = Json::array();
  for (std::size_t i = 0; i < content.channels.size(); ++i)
  {
    const double least = content.ranges[i][0];
    const double most = content.ranges[i][1];
    channels.push_back(
      { { "label", content.channels[i] }, { "color", "FFFFFF" }, { "active", true },
        { "window", { { "min", least }, { "max", most }, { "start", least }, { "end", most } } } });
  }
  return { { "channels", channels } };
}
}

glm::ivec3 chunksOf(const PyramidLevel& level)
{
  const int side = static_cast<int>(PyramidChunk);
  return (level.size - 1) / side + 1;
}

std::vector<PyramidLevel> pyramidLevels(const Grid& grid)
{
  constexpr double MostRatio = 1.5;
  std::vector<PyramidLevel> levels{ { grid.dimensions, glm::ivec3(1) } };
  while (chunksOf(levels.back()) != glm::ivec3(1))
  {
    const PyramidLevel& last = levels.back();
    const glm::dvec3 sides = glm::dvec3(last.step) * grid.spacing;
    double shortest = VTK_DOUBLE_MAX; // of the axes that can still be halved
    for (int axis = 0; axis < 3; ++axis)
    {
      shortest = last.size[axis] > 1 ? std::min(shortest, sides[axis]) : shortest;
    }
    PyramidLevel next = last;
    for (int axis = 0; axis < 3; ++axis)
    {
      if (last.size[axis] > 1 && sides[axis] <= MostRatio * shortest)
      {
        next.size[axis] = (last.size[axis] + 1) / 2;
        next.step[axis] = 2 * last.step[axis];
      }
    }
    levels.push_back(next);
  }
  return levels;
}

PyramidFile pyramidGroup(const PyramidContent& content, const std::vector<PyramidLevel>& levels)
{
  Json image = { { "name", "image" }, { "axes", axesOf(content) },
    { "datasets", datasetsOf(content, levels) }, { "type", content.isLabelMap ? "mode" : "mean" },
    { "metadata",
      { { "method", "BrainShift" },
        { "description",
          content.isLabelMap ? "each voxel has the most frequent label of those of the finer level"
                             : "each voxel is the mean of those of the finer level" } } } };
  const std::string version = content.isVersion3 ? "0.5" : "0.4";
  Json metadata = Json::object();
  (content.isVersion3 ? metadata : image)["version"] = version;
  metadata["multiscales"] = Json::array({ image });
  if (content.isLabelMap)
  {
    metadata["image-label"] = labelsOf(content, version);
  }
  if (!content.channels.empty())
  {
    metadata["omero"] = channelsOf(content);
  }
  if (content.isVersion3)
  {
    return { "zarr.json",
      { { "zarr_format", 3 }, { "node_type", "group" },
        { "attributes", { { "ome", metadata }, { "brainshift", ownOf(content, levels) } } } } };
  }
  metadata["brainshift"] = ownOf(content, levels);
  return { ".zattrs", metadata };
}

PyramidFile pyramidArray(
  const PyramidContent& content, const std::vector<PyramidLevel>& levels, std::size_t level)
{
  const glm::vec<3, std::int64_t> size(levels[level].size);
  return arrayFile(content, std::to_string(level),
    inAxes<std::int64_t>(content, content.components, size),
    inAxes<std::int64_t>(content, 1, glm::vec<3, std::int64_t>(PyramidChunk)), content.type);
}

PyramidFile pyramidBricks(
  const PyramidContent& content, const std::vector<PyramidLevel>& levels, std::size_t level)
{
  const glm::vec<3, std::int64_t> count(chunksOf(levels[level]));
  std::vector<std::int64_t> shape = inAxes<std::int64_t>(content, content.components, count);
  shape.push_back(2);
  PyramidFile file =
    arrayFile(content, "bricks/" + std::to_string(level), shape, shape, VTK_DOUBLE);
  file.json["fill_value"] = "NaN"; // so that no copy leaves out bricks that are zero
  return file;
}
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/OMEZarr/OMEImage.h"

#include "Common/ImageGrid.h"
#include "Common/Problem.h"
#include "Formats/Files/Text.h"
#include "Formats/OMEZarr/OMEUnits.h"
#include "Formats/OMEZarr/PyramidPlan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace brainshift
{
namespace
{
constexpr std::size_t MostImages = 1024;
constexpr std::size_t MostLevels = 64;
constexpr std::size_t MostTransformations = 16;

// What OME's rules say of a group. Version 0.5 keeps it in a member of its own.
struct Group
{
  Json metadata = Json::object();
  Json own; // BrainShift's own metadata
  bool isThere = false;
  bool isArray = false;
  bool isVersion3 = false; // of zarr
};

Group groupAt(const ZarrStore& store, const std::string& path)
{
  Group group;
  if (const std::optional<Json> json = readJson(store, keyIn(path, "zarr.json")))
  {
    group.isThere = group.isVersion3 = true;
    group.isArray = textIn(memberOf(*json, "node_type")) == "array";
    group.metadata = memberOf(memberOf(*json, "attributes"), "ome");
    group.own = memberOf(memberOf(*json, "attributes"), "brainshift");
  }
  else if (const std::optional<Json> json = readJson(store, keyIn(path, ".zattrs")))
  {
    group.isThere = true;
    group.metadata = *json;
    group.own = memberOf(*json, "brainshift");
  }
  group.isThere = group.isThere || store.size(keyIn(path, ".zgroup")).has_value();
  group.isArray = group.isArray || store.size(keyIn(path, ".zarray")).has_value();
  return group;
}

void requireVersion(const Json& version, const Group& group)
{
  const std::string text = textIn(version);
  const bool isKnown = group.isVersion3 ? text == "0.5" : text == "0.4" || version.is_null();
  if (!isKnown)
  {
    throw Problem("has the OME-Zarr version " + shownJson(version) + " in zarr format " +
      (group.isVersion3 ? "3" : "2") + "; BrainShift reads 0.4 in format 2 and 0.5 in format 3");
  }
}

// ---- Images of a store

void addImages(const Group& group, const std::string& path, std::vector<OMEChoice>& found)
{
  const Json& images = memberOf(group.metadata, "multiscales");
  for (std::size_t i = 0; i < (images.is_array() ? images.size() : 0); ++i)
  {
    throwIfAny(found.size() < MostImages
        ? ""
        : "has more than " + std::to_string(MostImages) + " images, which is the limit");
    const std::string name = path.empty() ? "image" : path;
    found.push_back({ i == 0 ? name : name + " " + std::to_string(i + 1), path, i });
  }
}

// The images of the group and of its labels.
void addWithLabels(const ZarrStore& store, const std::string& path, std::vector<OMEChoice>& found)
{
  addImages(groupAt(store, path), path, found);
  const std::string folder = keyIn(path, "labels");
  const Json list = memberOf(groupAt(store, folder).metadata, "labels");
  for (const Json& name : list.is_array() ? list : Json::array())
  {
    requireInside(textIn(name));
    const std::string label = keyIn(folder, textIn(name));
    addImages(groupAt(store, label), label, found);
  }
}

// The images that Bio-Formats writes beside each other.
void addSeries(const ZarrStore& store, std::vector<OMEChoice>& found)
{
  const Json list = memberOf(groupAt(store, "OME").metadata, "series");
  if (list.is_array() && list.size() > MostImages)
  {
    throw Problem("names " + std::to_string(list.size()) + " images in its series; it may name " +
      std::to_string(MostImages) + ". Open the folder of one of them");
  }
  for (const Json& name : list.is_array() ? list : Json::array())
  {
    requireInside(textIn(name));
    addWithLabels(store, textIn(name), found);
  }
  for (std::size_t i = 0; !list.is_array() && i <= MostImages; ++i)
  {
    if (!groupAt(store, std::to_string(i)).isThere)
    {
      break;
    }
    addWithLabels(store, std::to_string(i), found);
  }
}

[[noreturn]] void failWithoutImage(const Group& top)
{
  if (!memberOf(top.metadata, "plate").is_null() || !memberOf(top.metadata, "well").is_null())
  {
    throw Problem("is a plate or a well of a plate; open one of its images, such as A/1/0 in it");
  }
  throw Problem(top.isArray
      ? "is an array, which does not say where it is; open the folder of its image"
      : "has no multiscales: it holds no image of OME-Zarr 0.4 or 0.5");
}

// ---- Axes

bool isSpace(const Json& axis)
{
  const std::string type = textIn(memberOf(axis, "type"));
  const std::string name = lowerCase(textIn(memberOf(axis, "name")));
  return type == "space" || (type.empty() && (name == "x" || name == "y" || name == "z"));
}

bool isOfType(const Json& axis, const std::string& type, const std::string& name)
{
  const Json& stated = memberOf(axis, "type");
  return textIn(stated) == type || (stated.is_null() && textIn(memberOf(axis, "name")) == name);
}

// Says which axes of space name no unit.
void warnOfUnits(
  const Json& list, const std::vector<int>& space, std::vector<std::string>& warnings)
{
  std::vector<std::string> names;
  for (const int place : space)
  {
    const Json& axis = list[static_cast<std::size_t>(place)];
    if (memberOf(axis, "unit").is_null())
    {
      names.push_back(shownJson(memberOf(axis, "name")));
    }
  }
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    text += (i == 0 ? "" : i + 1 < names.size() ? ", " : " and ") + names[i];
  }
  if (!names.empty())
  {
    warnings.push_back("names no unit of the " + std::string(names.size() > 1 ? "axes " : "axis ") +
      text + "; mm is taken");
  }
}

// The factor of an axis's unit; 1 with a warning where it names none that is known. Of space,
// warnOfUnits speaks of axes without a unit.
double unitOf(const Json& axis, bool isTime, std::vector<std::string>& warnings)
{
  const Json& unit = memberOf(axis, "unit");
  const std::optional<double> known =
    isTime ? secondsIn(textIn(unit)) : millimetresIn(textIn(unit));
  if (!known && (isTime || !unit.is_null()))
  {
    warnings.push_back("names " + (unit.is_null() ? "no unit" : "the unit " + shownJson(unit)) +
      " of the axis " + shownJson(memberOf(axis, "name")) + "; " +
      (isTime ? "s is taken" : "mm is taken"));
  }
  return known.value_or(1.0);
}

// Where an axis leads in the patient, in RAS; 0 if it does not say so in the words for a standing
// person. Orientations are RFC 4 of NGFF; its other words are those of animals and embryos.
glm::dvec3 directionOf(const Json& axis)
{
  static const std::map<std::string, glm::dvec3> Known{ { "left-to-right", { 1, 0, 0 } },
    { "right-to-left", { -1, 0, 0 } }, { "posterior-to-anterior", { 0, 1, 0 } },
    { "anterior-to-posterior", { 0, -1, 0 } }, { "inferior-to-superior", { 0, 0, 1 } },
    { "superior-to-inferior", { 0, 0, -1 } } };
  const Json& orientation = memberOf(axis, "orientation");
  const auto found = Known.find(textIn(memberOf(orientation, "value")));
  const bool isKnown =
    textIn(memberOf(orientation, "type")) == "anatomical" && found != Known.end();
  return isKnown ? found->second : glm::dvec3(0.0);
}

// The sides of the patient, if each axis of space leads along another one.
void readOrientations(const Json& list, OMEImage& image)
{
  glm::dmat3 directions(0.0);
  bool isSaid = false;
  for (int i = 0; i < 3; ++i)
  {
    const int axis = image.axes.space[static_cast<std::size_t>(i)];
    directions[i] = axis < 0 ? glm::dvec3(0.0) : directionOf(list[static_cast<std::size_t>(axis)]);
    isSaid = isSaid || directions[i] != glm::dvec3(0.0);
  }
  image.knowsSides = glm::determinant(directions) != 0.0;
  image.rasFromAxes = image.knowsSides ? directions : image.rasFromAxes;
  if (isSaid && !image.knowsSides)
  {
    image.warnings.emplace_back("gives orientations that do not name another side of the patient "
                                "for each of the axes x, y and z; they are not used");
  }
}

// Which axes are x, y and z: by their names or, where they have others, by their order.
void placeSpace(const Json& list, const std::vector<int>& space, OMEImage& image)
{
  if (space.size() < 2 || space.size() > 3)
  {
    throw Problem("has " + std::to_string(space.size()) + " axes of space; it must have 2 or 3");
  }
  std::array<int, 3> named{ -1, -1, -1 };
  std::size_t count = 0;
  std::string names;
  for (const int axis : space)
  {
    const std::string name = textIn(memberOf(list[static_cast<std::size_t>(axis)], "name"));
    const std::size_t place = std::string("xyz").find(lowerCase(name));
    if (name.size() == 1 && place != std::string::npos && named[place] < 0)
    {
      named[place] = axis;
      ++count;
    }
    names += (names.empty() ? "'" : ", '") + shownWords(name) + "'";
  }
  if (count == space.size() && named[0] >= 0 && named[1] >= 0)
  {
    image.axes.space = named;
    return;
  }
  image.warnings.push_back("names its axes of space " + names + "; they are taken as " +
    (space.size() == 3 ? "z, y, x" : "y, x"));
  for (std::size_t i = 0; i < space.size(); ++i)
  {
    image.axes.space[i] = space[space.size() - 1 - i];
  }
}

void takeOnce(int axis, const char* what, int& place)
{
  throwIfAny(place < 0 ? "" : std::string("has two axes of ") + what + "; it may have one");
  place = axis;
}

void readAxes(const Json& list, OMEImage& image)
{
  constexpr std::size_t Most = 5;
  if (!list.is_array() || list.size() < 2 || list.size() > Most)
  {
    throw Problem("has the axes " + shownJson(list) + "; they must be a list of 2 to 5");
  }
  std::vector<int> space;
  for (const Json& axis : list)
  {
    throwIfAny(memberOf(axis, "name").is_string()
        ? ""
        : "has the axis " + shownJson(axis) + "; it must have a name, as from OME-Zarr 0.4 on");
    const int place = static_cast<int>(image.axes.units.size());
    double unit = 1.0;
    if (isSpace(axis))
    {
      space.push_back(place);
      unit = unitOf(axis, false, image.warnings);
    }
    else if (isOfType(axis, "time", "t"))
    {
      takeOnce(place, "time", image.axes.time);
      unit = unitOf(axis, true, image.warnings);
    }
    else if (isOfType(axis, "channel", "c"))
    {
      takeOnce(place, "channels", image.axes.channel);
    }
    image.axes.units.push_back(unit);
  }
  warnOfUnits(list, space, image.warnings);
  placeSpace(list, space, image);
  readOrientations(list, image);
}

// ---- Levels

void takeTransformations(const Json& list, OMELevel& level, bool mustScale)
{
  bool hasScale = false;
  if (!list.is_array() && !list.is_null())
  {
    throw Problem("has the coordinateTransformations " + shownJson(list) + "; they must be a list");
  }
  if (list.size() > MostTransformations)
  {
    throw Problem("has " + std::to_string(list.size()) +
      " coordinateTransformations; it may have " + std::to_string(MostTransformations));
  }
  for (const Json& entry : list)
  {
    const std::string type = textIn(memberOf(entry, "type"));
    if (type == "identity")
    {
      continue;
    }
    if (type != "scale" && type != "translation")
    {
      throw Problem("has the coordinateTransformation " + shownJson(entry) +
        "; BrainShift reads scale, translation and identity");
    }
    const std::vector<double> numbers =
      realNumbersIn(memberOf(entry, type.c_str()), level.scale.size(), type);
    for (std::size_t axis = 0; axis < numbers.size(); ++axis)
    {
      level.scale[axis] *= type == "scale" ? numbers[axis] : 1.0;
      level.translation[axis] = type == "scale" ? level.translation[axis] * numbers[axis]
                                                : level.translation[axis] + numbers[axis];
    }
    hasScale = hasScale || type == "scale";
  }
  throwIfAny(hasScale || !mustScale ? "" : "has no scale, so its place is not known");
}

// Axes that are neither of space nor time nor channels.
void requireNoOther(const OMEAxes& axes, const Json& list, const ZarrArray& array)
{
  for (std::size_t i = 0; i < array.shape.size(); ++i)
  {
    const int axis = static_cast<int>(i);
    const bool isKnown = axis == axes.time || axis == axes.channel ||
      std::find(axes.space.begin(), axes.space.end(), axis) != axes.space.end();
    if (!isKnown && array.shape[i] != 1)
    {
      throw Problem("has " + std::to_string(array.shape[i]) + " numbers along the axis " +
        shownJson(list[i]) + "; BrainShift reads axes of space, time and channels");
    }
  }
}

OMELevel readLevel(
  const ZarrStore& store, const std::string& group, const Json& dataset, std::size_t rank)
{
  const std::string path = textIn(memberOf(dataset, "path"));
  requireInside(path);
  OMELevel level{ readZarrArray(store, keyIn(group, path)), std::vector<double>(rank, 1.0),
    std::vector<double>(rank, 0.0), {} };
  const std::vector<std::int64_t>& shape = level.array.shape;
  if (shape.size() != rank)
  {
    throw Problem("has an array '" + shownWords(path) + "' of " + std::to_string(shape.size()) +
      " axes; the image has " + std::to_string(rank));
  }
  if (*std::max_element(shape.begin(), shape.end()) > std::numeric_limits<int>::max())
  {
    throw Problem("has an array '" + shownWords(path) + "' of " +
      std::to_string(*std::max_element(shape.begin(), shape.end())) +
      " numbers along an axis; it may have " + std::to_string(std::numeric_limits<int>::max()));
  }
  withBeginning("has a level '" + shownWords(path) + "' that ",
    [&] { takeTransformations(memberOf(dataset, "coordinateTransformations"), level, true); });
  return level;
}

// ---- Channels and labels

void readChannels(const Json& omero, OMEImage& image)
{
  const Json& list = memberOf(omero, "channels");
  for (const Json& channel : list.is_array() ? list : Json::array())
  {
    image.channels.push_back(validUtf8(textIn(memberOf(channel, "label"))));
  }
}

// The value of a label in its JSON; none if labels of volumes cannot have it.
std::optional<int> labelValue(const Json& entry)
{
  const Json& value = memberOf(entry, "label-value");
  const double number = value.is_number_integer() ? value.get<double>() : 4e9;
  const bool isHeld =
    number >= std::numeric_limits<int>::min() && number <= std::numeric_limits<int>::max();
  return isHeld ? std::optional<int>(static_cast<int>(number)) : std::nullopt;
}

void readColor(const Json& rgba, Label& label)
{
  for (std::size_t i = 0; rgba.is_array() && rgba.size() >= 3 && i < 3; ++i)
  {
    const double part = rgba[i].is_number() ? rgba[i].get<double>() : 255.0;
    label.color[i] = static_cast<unsigned char>(part > 0.0 ? std::min(part, 255.0) : 0.0);
  }
}

void readLabels(const Json& metadata, OMEImage& image)
{
  std::map<int, Label> labels;
  std::size_t omitted = 0;
  for (const char* list : { "colors", "properties" })
  {
    const Json& entries = memberOf(metadata, list);
    for (const Json& entry : entries.is_array() ? entries : Json::array())
    {
      const std::optional<int> value = labelValue(entry);
      omitted += value ? 0 : 1;
      if (!value)
      {
        continue;
      }
      Label& label =
        labels.try_emplace(*value, Label{ *value, std::to_string(*value), { 255, 255, 255 }, {} })
          .first->second;
      readColor(memberOf(entry, "rgba"), label);
      for (const char* name : { "class", "label", "name" }) // the last counts
      {
        label.name = validUtf8(textIn(memberOf(entry, name), label.name));
      }
    }
  }
  for (const auto& [value, label] : labels)
  {
    image.labels.push_back(label);
  }
  if (omitted > 0)
  {
    image.warnings.push_back("names " + std::to_string(omitted) +
      " labels whose values are no integers of 32 bits; their names and colours are left out");
  }
}

// ---- What BrainShift's writer adds

// The writer names them, and it writes every chunk.
void readBricks(const Json& names, const std::string& path, OMEImage& image)
{
  for (std::size_t i = 0; names.is_array() && i < std::min(names.size(), image.levels.size()); ++i)
  {
    const std::string name = textIn(names[i]);
    requireInside(name);
    image.levels[i].bricks = keyIn(path, name);
    image.levels[i].array.hasAllChunks = true;
  }
}

void readOwn(const Json& own, const std::string& path, OMEImage& image)
{
  constexpr std::size_t Axes = 3;
  const Json& world = memberOf(own, "world");
  throwIfAny(world.is_null() || world == Json("RAS")
      ? ""
      : "names the world " + shownJson(world) + "; BrainShift reads RAS");
  if (!world.is_null())
  {
    image.knowsSides = true;
    image.rasFromAxes = glm::dmat3(1.0);
  }
  readBricks(memberOf(own, "bricks"), path, image);
  const Json& rows = memberOf(own, "direction");
  if (rows.is_null())
  {
    return;
  }
  const auto& space = image.axes.space;
  throwIfAny(
    rows.is_array() && rows.size() == Axes && *std::min_element(space.begin(), space.end()) >= 0
      ? ""
      : "has the direction " + shownJson(rows) + "; it must be three rows, of an image in x, y, z");
  for (std::size_t row = 0; row < Axes; ++row)
  {
    const std::vector<double> numbers = realNumbersIn(rows[row], Axes, "direction");
    for (std::size_t column = 0; column < Axes; ++column)
    {
      image.direction[static_cast<int>(column)][static_cast<int>(row)] = numbers[column];
    }
  }
  const glm::dmat3 product = glm::transpose(image.direction) * image.direction;
  for (int i = 0; i < 9; ++i)
  {
    const double miss = std::abs(product[i / 3][i % 3] - (i / 3 == i % 3 ? 1.0 : 0.0));
    throwIfAny(miss <= MostMissOfRotation
        ? ""
        : "has the direction " + shownJson(rows) + ", which is no rotation");
  }
}
}

std::vector<OMEChoice> imagesOf(const ZarrStore& store)
{
  if (store.size(UnfinishedMark))
  {
    throw Problem("was not written to its end; write it again under this name to go on");
  }
  std::vector<OMEChoice> found;
  addWithLabels(store, "", found);
  const Group top = groupAt(store, "");
  if (found.empty())
  {
    const Json list = memberOf(top.metadata, "labels"); // the folder of labels itself was opened
    for (const Json& name : list.is_array() ? list : Json::array())
    {
      requireInside(textIn(name));
      addImages(groupAt(store, textIn(name)), textIn(name), found);
    }
  }
  if (found.empty() && !memberOf(top.metadata, "bioformats2raw.layout").is_null())
  {
    addSeries(store, found);
  }
  if (found.empty())
  {
    failWithoutImage(top);
  }
  return found;
}

OMEImage readOMEImage(const ZarrStore& store, const OMEChoice& choice)
{
  const Group group = groupAt(store, choice.path);
  const Json& list = memberOf(group.metadata, "multiscales");
  throwIfAny(list.is_array() && choice.index < list.size() ? "" : "has no image " + choice.name);
  const Json& metadata = list[choice.index];
  requireVersion(memberOf(group.isVersion3 ? group.metadata : metadata, "version"), group);
  OMEImage image;
  readAxes(memberOf(metadata, "axes"), image);
  const Json& datasets = memberOf(metadata, "datasets");
  if (!datasets.is_array() || datasets.empty() || datasets.size() > MostLevels)
  {
    throw Problem("has " + std::to_string(datasets.is_array() ? datasets.size() : 0) +
      " datasets; it must have 1 to " + std::to_string(MostLevels));
  }
  for (const Json& dataset : datasets)
  {
    OMELevel level = readLevel(store, choice.path, dataset, image.axes.units.size());
    takeTransformations(memberOf(metadata, "coordinateTransformations"), level, false);
    requireNoOther(image.axes, memberOf(metadata, "axes"), level.array);
    image.levels.push_back(std::move(level));
  }
  readChannels(memberOf(group.metadata, "omero"), image);
  const Json& labels = memberOf(group.metadata, "image-label");
  const int type = image.levels.front().array.type.vtkType;
  image.isLabelMap = !labels.is_null() && type != VTK_FLOAT && type != VTK_DOUBLE;
  readLabels(labels, image);
  withBeginning(
    "has own metadata of BrainShift that ", [&] { readOwn(group.own, choice.path, image); });
  return image;
}
}

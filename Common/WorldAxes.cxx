// SPDX-License-Identifier: BSD-3-Clause
#include "Common/WorldAxes.h"

#include "Common/FieldWord.h"

#include <algorithm>
#include <iterator>

namespace brainshift
{
namespace
{
constexpr const char* ArrayName = "WorldAxes";
constexpr const char* RASName = "RAS";
constexpr const char* LPSName = "LPS";

constexpr const char* TemplateArrayName = "Template";
constexpr const char* SlicerArrayName = "SPACE"; // in .vtp files

struct TemplateName
{
  Template space;
  const char* name;
};

constexpr TemplateName TemplateNames[] = { { Template::None, "" },
  { Template::Talairach, "Talairach" }, { Template::MNI152, "MNI 152" },
  { Template::Other, "not named" } };

const char* nameOf(WorldAxes axes, const char* unknown)
{
  return axes == WorldAxes::RAS ? RASName : axes == WorldAxes::LPS ? LPSName : unknown;
}

WorldAxes axesNamed(const std::string& name)
{
  return name == RASName ? WorldAxes::RAS : name == LPSName ? WorldAxes::LPS : WorldAxes::Unknown;
}

const char* nameOf(Template space)
{
  return std::find_if(std::begin(TemplateNames), std::end(TemplateNames),
    [&](const TemplateName& known) { return known.space == space; })
    ->name;
}

std::string wordsOnTemplates(const NamedAxes& one, const NamedAxes& other)
{
  const bool isNone = one.space == Template::None || other.space == Template::None;
  const bool isUnnamed = one.space == Template::Other || other.space == Template::Other;
  if (one.space == other.space || (isUnnamed && !isNone))
  {
    return {};
  }
  const auto space = [](const NamedAxes& thing) {
    return thing.space == Template::None
      ? " in no template's"
      : std::string(" in the space of a template (") + nameOf(thing.space) + ")";
  };
  const NamedAxes& first = one.space == Template::None ? other : one;
  const NamedAxes& second = one.space == Template::None ? one : other;
  return "By their files, " + first.noun + " is" + space(first) + " and " + second.noun + " is" +
    space(second) +
    ": they fit each other only if they were registered. Check it in a picture of both";
}
}

void nameWorldAxes(vtkDataObject* volume, WorldAxes axes)
{
  setFieldWord(volume, ArrayName, nameOf(axes, ""));
}

WorldAxes worldAxesOf(vtkDataObject* volume)
{
  return axesNamed(fieldWordOf(volume, ArrayName));
}

void nameTemplate(vtkDataObject* data, Template space)
{
  setFieldWord(data, TemplateArrayName, nameOf(space));
}

Template templateOf(vtkDataObject* data)
{
  const std::string name = fieldWordOf(data, TemplateArrayName);
  const TemplateName* found = std::find_if(std::begin(TemplateNames), std::end(TemplateNames),
    [&](const TemplateName& known) { return known.name == name; });
  return found == std::end(TemplateNames) ? Template::None : found->space;
}

NamedAxes namedAxesOf(const std::string& noun, vtkDataObject* data)
{
  const WorldAxes own = worldAxesOf(data);
  const WorldAxes ofSlicer = axesNamed(fieldWordOf(data, SlicerArrayName));
  const bool isOfSlicer = own == WorldAxes::Unknown && ofSlicer != WorldAxes::Unknown;
  return { isOfSlicer ? noun + " (by its field array SPACE)" : noun, isOfSlicer ? ofSlicer : own,
    templateOf(data) };
}

std::string wordsOnSides(const NamedAxes& one, const NamedAxes& other)
{
  return one.axes == other.axes
    ? wordsOnTemplates(one, other)
    : "The world axes of " + one.noun + " are " + nameOf(one.axes, "unknown") + ", and those of " +
      other.noun + " are " + nameOf(other.axes, "unknown") +
      ": left and right may be exchanged between them. Check it in a picture of both";
}

std::string wordsOnSidesOf(const NamedAxes& guest, vtkDataObject* volume)
{
  NamedAxes host = namedAxesOf("the volume", volume);
  host.space = guest.space == Template::None ? Template::None : host.space;
  return guest.axes == WorldAxes::Unknown ? std::string() : wordsOnSides(host, guest);
}
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Common/WorldAxes.h"

#include "Common/FieldWord.h"

namespace brainshift
{
namespace
{
constexpr const char* ArrayName = "WorldAxes";
constexpr const char* RASName = "RAS";
constexpr const char* LPSName = "LPS";

const char* nameOf(WorldAxes axes, const char* unknown)
{
  return axes == WorldAxes::RAS ? RASName : axes == WorldAxes::LPS ? LPSName : unknown;
}
}

void nameWorldAxes(vtkDataObject* volume, WorldAxes axes)
{
  setFieldWord(volume, ArrayName, nameOf(axes, ""));
}

WorldAxes worldAxesOf(vtkDataObject* volume)
{
  const std::string name = fieldWordOf(volume, ArrayName);
  if (name == RASName)
  {
    return WorldAxes::RAS;
  }
  return name == LPSName ? WorldAxes::LPS : WorldAxes::Unknown;
}

std::string wordsOnSides(const NamedAxes& one, const NamedAxes& other)
{
  return one.axes == other.axes
    ? std::string()
    : "The world axes of " + one.noun + " are " + nameOf(one.axes, "unknown") + ", and those of " +
      other.noun + " are " + nameOf(other.axes, "unknown") +
      ": left and right may be exchanged between them. Check it in a picture of both";
}

std::string wordsOnSidesOf(const NamedAxes& guest, vtkDataObject* volume)
{
  return guest.axes == WorldAxes::Unknown
    ? std::string()
    : wordsOnSides({ "the volume", worldAxesOf(volume) }, guest);
}
}

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
}

void nameWorldAxes(vtkDataObject* volume, WorldAxes axes)
{
  setFieldWord(volume, ArrayName,
    axes == WorldAxes::RAS     ? RASName
      : axes == WorldAxes::LPS ? LPSName
                               : "");
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
}

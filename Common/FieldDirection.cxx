// SPDX-License-Identifier: BSD-3-Clause
#include "Common/FieldDirection.h"

#include "Common/FieldWord.h"

namespace brainshift
{
namespace
{
constexpr const char* ArrayName = "DisplacementDirection";
constexpr const char* ForwardName = "forward";
constexpr const char* BackwardName = "backward";
}

void nameDirection(vtkDataObject* field, Direction direction)
{
  setFieldWord(field, ArrayName, direction == Direction::Forward ? ForwardName : BackwardName);
}

void forgetDirection(vtkDataObject* field)
{
  setFieldWord(field, ArrayName, "");
}

std::optional<Direction> directionOf(vtkDataObject* field)
{
  const std::string name = fieldWordOf(field, ArrayName);
  if (name == ForwardName)
  {
    return Direction::Forward;
  }
  return name == BackwardName ? std::optional<Direction>(Direction::Backward) : std::nullopt;
}
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Tools/HandTool.h"

#include <cmath>

namespace brainshift
{
HandTool::HandTool(const ToolBench& bench)
  : Bench(bench)
{
}

HandTool::~HandTool() = default;

bool HandTool::wheel(const HandEvent&)
{
  return false;
}

void HandTool::idle()
{
  this->Bench.drawing.Clear();
}

void HandTool::release()
{
  this->settle();
}

void HandTool::cancel()
{
  this->Bench.editor.cancel();
}

void HandTool::settle() {}

void HandTool::turnAway()
{
  this->settle();
}

Stroke HandTool::strokeAt(const glm::dvec3& anchor, Tool tool) const
{
  const ToolSettings& settings = this->Bench.settings;
  Stroke stroke;
  stroke.tool = tool;
  stroke.anchor = anchor;
  const bool isSphere = shapeOf(tool) == StrokeShape::Sphere;
  stroke.major = isSphere ? settings.radius() : settings.majorRadius();
  stroke.minor = isSphere ? 0.0 : settings.minorRadius();
  stroke.sigma = settings.sigma();
  return stroke;
}

glm::dvec3 HandTool::pulledInPlane(const Grip& grip, const glm::dvec2& pixel)
{
  const ViewProbe& probe = this->Bench.probe;
  const glm::dvec3& from = grip.spot.position;
  const auto along = [&](const glm::dvec3& normal) {
    return probe.positionAt(pixel, from, normal) - probe.positionAt(grip.pixel, from, normal);
  };
  const glm::dvec3 ahead = probe.ahead();
  if (!grip.spot.slice)
  {
    return along(ahead);
  }
  // A slice seen from its edge would run away under the hand: there it follows as seen.
  const glm::dvec3& normal = *grip.spot.slice;
  constexpr double leastCosine = 0.2;
  const glm::dvec3 asSeen = along(ahead);
  return std::abs(glm::dot(normal, ahead)) < leastCosine
    ? asSeen - glm::dot(asSeen, normal) * normal
    : along(normal);
}

glm::dvec3 HandTool::pulled(const Grip& grip, const glm::dvec2& pixel)
{
  ViewProbe& probe = this->Bench.probe;
  const ToolSettings::AxisHold hold = this->Bench.settings.axisHold();
  if (hold == ToolSettings::AxisHold::None)
  {
    return this->pulledInPlane(grip, pixel);
  }
  const glm::dvec3& from = grip.spot.position;
  glm::dvec3 axis(0.0);
  axis[static_cast<int>(hold) - static_cast<int>(ToolSettings::AxisHold::X)] = 1.0;
  // As far along the axis as the hand went along the axis' image on the screen.
  const double millimetre = probe.millimetresPerPixel(from); // short, so that perspective is none
  const glm::dvec2 onScreen = probe.pixelOf(from + millimetre * axis) - probe.pixelOf(from);
  constexpr double leastPixels = 0.1; // an axis that points at the eye cannot be followed
  const double length = glm::length(onScreen);
  if (length < leastPixels)
  {
    return glm::dvec3(0.0);
  }
  const double alongScreen = glm::dot(pixel - grip.pixel, onScreen / length);
  return alongScreen / length * millimetre * axis;
}

glm::dvec3 HandTool::beforeStrength(const glm::dvec3& displacement) const
{
  constexpr double least = 0.05; // below it nothing can follow the hand
  const double strength = this->Bench.probe.strength();
  return strength < least ? displacement : displacement / strength;
}

void HandTool::showStroke(const Stroke& stroke, const std::optional<glm::dvec3>& slice)
{
  const auto outline = [&](double fraction) {
    return slice ? std::vector<Polyline>{ sectionOf(stroke, fraction, *slice) }
                 : outlineOf(stroke, fraction);
  };
  vtkLatticeRepresentation& drawing = this->Bench.drawing;
  drawing.SetLines(vtkLatticeRepresentation::Strong, outline(1.0));
  drawing.SetLines(vtkLatticeRepresentation::Weak, outline(radiusOfHalfWeight(stroke.sigma)));
}
}

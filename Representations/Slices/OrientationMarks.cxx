// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Slices/OrientationMarks.h"

#include "Common/Guard.h"
#include "Representations/Scene/WindowText.h"
#include "Representations/Slices/SliceGeometry.h"

#include "vtkCamera.h"
#include "vtkCoordinate.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkProp3D.h"
#include "vtkRenderer.h"
#include "vtkTextProperty.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace brainshift
{
namespace
{
constexpr double Follows = 0.9;      // cosine between a direction and an axis, at least
constexpr double LeastDegrees = 5.0; // from an axis; less is not told
constexpr int FontSize = 22;
constexpr int NameFontSize = 16;
constexpr int WarningFontSize = 13;
const double WarningColor[3] = { 1.0, 0.75, 0.2 }; // amber
constexpr double Inset = 0.015;                    // from the edge, fraction of the view

// Right, left, upper and lower edge: position (fraction of the view) and the side of the letter
// that is at it.
struct Edge
{
  double x;
  double y;
  int horizontal;
  int vertical;
};
constexpr std::array<Edge, 4> Edges{ { { 1.0 - Inset, 0.5, VTK_TEXT_RIGHT, VTK_TEXT_CENTERED },
  { Inset, 0.5, VTK_TEXT_LEFT, VTK_TEXT_CENTERED },
  { 0.5, 1.0 - Inset, VTK_TEXT_CENTERED, VTK_TEXT_TOP },
  { 0.5, Inset, VTK_TEXT_CENTERED, VTK_TEXT_BOTTOM } } };

// Names of the sides towards greater and towards smaller coordinates.
struct Sides
{
  const char* greater[3];
  const char* smaller[3];
};

const Sides& sidesOf(WorldAxes axes)
{
  static const Sides unknown{ { "+x", "+y", "+z" }, { "-x", "-y", "-z" } };
  static const Sides ras{ { "R", "A", "S" }, { "L", "P", "I" } };
  static const Sides lps{ { "L", "P", "S" }, { "R", "A", "I" } };
  return axes == WorldAxes::RAS ? ras : axes == WorldAxes::LPS ? lps : unknown;
}

// " 12°"; nothing where the angle is too small to matter.
std::string angleText(double cosine)
{
  const double degrees = vtkMath::DegreesFromRadians(std::acos(std::min(std::abs(cosine), 1.0)));
  return degrees < LeastDegrees ? std::string()
                                : " " + std::to_string(std::lround(degrees)) + "\u00b0";
}

std::string letterOf(const double direction[3], int axis, double sign, const Sides& sides)
{
  return (sign * direction[axis] > 0.0 ? sides.greater : sides.smaller)[axis] +
    angleText(direction[axis]);
}

// The axes that two directions follow best, each another one.
std::pair<int, int> nearestAxes(const double right[3], const double up[3])
{
  std::pair<int, int> nearest(0, 1);
  double best = -1.0;
  for (int axis = 0; axis < 9; ++axis)
  {
    const std::pair<int, int> axes(axis / 3, axis % 3);
    const double follows = std::abs(right[axes.first]) + std::abs(up[axes.second]);
    if (axes.first != axes.second && follows > best)
    {
      best = follows;
      nearest = axes;
    }
  }
  return nearest;
}
}

std::array<std::string, 4> edgeLetters(
  const double right[3], const double up[3], WorldAxes axes, bool always)
{
  const Sides& sides = sidesOf(axes);
  const auto [across, upwards] = nearestAxes(right, up);
  if (!always && (std::abs(right[across]) < Follows || std::abs(up[upwards]) < Follows))
  {
    return {};
  }
  return { letterOf(right, across, 1.0, sides), letterOf(right, across, -1.0, sides),
    letterOf(up, upwards, 1.0, sides), letterOf(up, upwards, -1.0, sides) };
}

vtkStandardNewMacro(OrientationMarks);

OrientationMarks::OrientationMarks()
{
  this->PickableOff();
  this->UseBoundsOff();
  for (std::size_t i = 0; i < Edges.size(); ++i)
  {
    vtkTextActor* letter = this->Letters[i];
    letter->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
    letter->SetPosition(Edges[i].x, Edges[i].y);
    vtkTextProperty* text = letter->GetTextProperty();
    text->SetFontSize(FontSize);
    text->SetBold(true);
    text->SetJustification(Edges[i].horizontal);
    text->SetVerticalJustification(Edges[i].vertical);
  }
  this->Name->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  this->Name->SetPosition(Inset, 1.0 - Inset);
  this->Name->GetTextProperty()->SetFontSize(NameFontSize);
  this->Name->GetTextProperty()->SetBold(true);
  this->Name->GetTextProperty()->SetVerticalJustification(VTK_TEXT_TOP);
  this->Warning->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  this->Warning->SetPosition(Inset, Inset);
  // The last line is left to the letter of the lower edge.
  this->Warning->SetInput("Patient sides unknown:\nset World Axes\n ");
  vtkTextProperty* text = this->Warning->GetTextProperty();
  text->SetFontSize(WarningFontSize);
  text->SetBold(true);
  text->SetColor(WarningColor);
  text->SetVerticalJustification(VTK_TEXT_BOTTOM);
}

OrientationMarks::~OrientationMarks() = default;

std::array<double, 3> OrientationMarks::AlongAxes(const double direction[3]) const
{
  vtkNew<vtkMatrix4x4> worldFromVolume;
  if (this->Volume)
  {
    this->Volume->GetMatrix(worldFromVolume);
  }
  std::array<double, 3> cosines{};
  for (int axis = 0; axis < 3; ++axis)
  {
    double length = 0.0;
    for (int row = 0; row < 3; ++row)
    {
      const double part = worldFromVolume->GetElement(row, axis);
      cosines[axis] += part * direction[row];
      length = std::hypot(length, part);
    }
    cosines[axis] = length > 0.0 ? cosines[axis] / length : 0.0;
  }
  return cosines;
}

void OrientationMarks::Write(vtkViewport* viewport)
{
  auto renderer = vtkRenderer::SafeDownCast(viewport);
  vtkMatrix4x4* viewFromWorld = renderer->GetActiveCamera()->GetViewTransformMatrix();
  const std::array<double, 3> right = this->AlongAxes(viewFromWorld->GetData());
  const std::array<double, 3> up = this->AlongAxes(viewFromWorld->GetData() + 4);
  const std::array<double, 3> back = this->AlongAxes(viewFromWorld->GetData() + 8);
  auto letters = edgeLetters(right.data(), up.data(), this->Axes, this->GridAxisAlong(back) >= 0);
  this->Warning->SetVisibility(
    this->ShowLetters && this->Axes == WorldAxes::Unknown && !letters[0].empty());
  for (std::size_t i = 0; i < letters.size(); ++i)
  {
    this->Letters[i]->SetInput(this->ShowLetters ? letters[i].c_str() : "");
  }
  this->WriteName(back);
}

int OrientationMarks::GridAxisAlong(const std::array<double, 3>& back) const
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::array<double, 3>& along = this->GridAxes[axis];
    if (std::abs(vtkMath::Dot(along.data(), back.data())) >= Follows)
    {
      return axis;
    }
  }
  return -1;
}

void OrientationMarks::WriteName(const std::array<double, 3>& back)
{
  this->Name->SetInput("");
  const glm::ivec3 across = axesAcrossPlanes({ glm::make_vec3(this->GridAxes[0].data()),
    glm::make_vec3(this->GridAxes[1].data()), glm::make_vec3(this->GridAxes[2].data()) });
  const int axis = this->GridAxisAlong(back);
  for (int plane = 0; plane < 3; ++plane)
  {
    if (this->NamedPlanes[plane] && across[plane] == axis)
    {
      const std::array<double, 3>& color = PlaneColors[plane];
      this->Name->SetInput((PlaneNames[plane] + angleText(back[plane])).c_str());
      this->Name->GetTextProperty()->SetColor(color[0], color[1], color[2]);
    }
  }
}

std::vector<vtkTextActor*> OrientationMarks::Texts() const
{
  std::vector<vtkTextActor*> texts{ this->Letters.begin(), this->Letters.end() };
  texts.push_back(this->Name);
  texts.push_back(this->Warning);
  texts.erase(std::remove_if(texts.begin(), texts.end(),
                [](vtkTextActor* text) { return !text->GetVisibility() || !*text->GetInput(); }),
    texts.end());
  return texts;
}

int OrientationMarks::RenderOpaqueGeometry(vtkViewport* viewport)
{
  return guarded(this, 0, [&] {
    this->Write(viewport);
    int drawn = 0;
    for (vtkTextActor* text : this->Texts())
    {
      drawn += text->RenderOpaqueGeometry(viewport);
    }
    return drawn;
  });
}

int OrientationMarks::RenderOverlay(vtkViewport* viewport)
{
  return guarded(this, 0, [&] {
    int drawn = 0;
    for (vtkTextActor* text : this->Texts())
    {
      drawn += text->RenderOverlay(viewport);
    }
    return drawn;
  });
}

void OrientationMarks::ReleaseGraphicsResources(vtkWindow* window)
{
  for (auto& letter : this->Letters)
  {
    letter->ReleaseGraphicsResources(window);
  }
  this->Name->ReleaseGraphicsResources(window);
  this->Warning->ReleaseGraphicsResources(window);
  this->Superclass::ReleaseGraphicsResources(window);
}
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Slices/OrientationMarks.h"

#include "vtkCamera.h"
#include "vtkCoordinate.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkRenderer.h"
#include "vtkTextActor.h"
#include "vtkTextProperty.h"

#include <cmath>
#include <cstddef>

namespace brainshift
{
namespace
{
constexpr double Follows = 0.9; // cosine between a direction and an axis, at least
constexpr int FontSize = 18;
constexpr double Inset = 0.015; // from the edge, share of the view

// Right, left, upper and lower edge: place, share of the view, and which side of a letter is there.
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

std::string letterOf(const double direction[3], double sign)
{
  static const char* const above[] = { "R", "A", "S" };
  static const char* const below[] = { "L", "P", "I" };
  for (int axis = 0; axis < 3; ++axis)
  {
    if (std::abs(direction[axis]) >= Follows)
    {
      return sign * direction[axis] > 0.0 ? above[axis] : below[axis];
    }
  }
  return {};
}
}

std::array<std::string, 4> edgeLetters(const double right[3], const double up[3])
{
  std::array<std::string, 4> letters{ letterOf(right, 1.0), letterOf(right, -1.0),
    letterOf(up, 1.0), letterOf(up, -1.0) };
  const bool alongAxis = !letters[0].empty() && !letters[2].empty();
  return alongAxis ? letters : std::array<std::string, 4>{};
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
}

OrientationMarks::~OrientationMarks() = default;

int OrientationMarks::RenderOpaqueGeometry(vtkViewport* viewport)
{
  auto renderer = vtkRenderer::SafeDownCast(viewport);
  vtkMatrix4x4* viewFromWorld = renderer->GetActiveCamera()->GetViewTransformMatrix();
  const auto letters = edgeLetters(viewFromWorld->GetData(), viewFromWorld->GetData() + 4);
  int drawn = 0;
  for (std::size_t i = 0; i < letters.size(); ++i)
  {
    this->Letters[i]->SetInput(letters[i].c_str());
    drawn += letters[i].empty() ? 0 : this->Letters[i]->RenderOpaqueGeometry(viewport);
  }
  return drawn;
}

int OrientationMarks::RenderOverlay(vtkViewport* viewport)
{
  int drawn = 0;
  for (auto& letter : this->Letters)
  {
    drawn += *letter->GetInput() ? letter->RenderOverlay(viewport) : 0;
  }
  return drawn;
}

void OrientationMarks::ReleaseGraphicsResources(vtkWindow* window)
{
  for (auto& letter : this->Letters)
  {
    letter->ReleaseGraphicsResources(window);
  }
  this->Superclass::ReleaseGraphicsResources(window);
}
}

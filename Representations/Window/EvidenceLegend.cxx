// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Window/EvidenceLegend.h"

#include "Common/Guard.h"
#include "Representations/Scene/Tints.h"

#include "vtkCoordinate.h"
#include "vtkObjectFactory.h"
#include "vtkTextProperty.h"
#include "vtkViewport.h"
#include "vtkWindow.h"

#include <algorithm>
#include <cstddef>
#include <sstream>

namespace brainshift
{
namespace
{
constexpr int FontSize = 14;
constexpr double Inset = 0.015; // from the edges, fraction of the view
constexpr double Spaced = 1.15; // from line to line, fraction of a line
constexpr double PointsPerInch = 72.0;
constexpr glm::vec3 Untinted(0.85f);
constexpr glm::vec3 Ink(0.08f);

std::string millimetres(float mm)
{
  std::ostringstream text;
  text << mm;
  return text.str();
}

// The heading and the classes; one sentence in two lines if there are none.
std::array<std::string, 5> wordsOf(EvidenceLegend::Shown shown)
{
  if (shown == EvidenceLegend::Shown::Nothing)
  {
    return { "This volume carries no uncertainty", "Its lattice must be a fit with Evidence on" };
  }
  const std::string first = millimetres(EvidenceLimits.x);
  const std::string second = millimetres(EvidenceLimits.y);
  const std::string last = millimetres(EvidenceLimits.z);
  const bool striped = shown == EvidenceLegend::Shown::Stripes;
  return { "Place known to (1 sd)", " below " + first + " mm " + (striped ? ": plain " : ""),
    " " + first + " to " + second + " mm " + (striped ? ": thin stripes " : ""),
    " " + second + " to " + last + " mm " + (striped ? ": stripes " : ""),
    striped ? " no evidence : wide stripes " : " no evidence, striped " };
}

glm::vec3 swatchOf(std::size_t line, EvidenceLegend::Shown shown)
{
  const bool tinted = shown == EvidenceLegend::Shown::Tints && line > 1;
  return tinted ? EvidenceTints[static_cast<int>(line) - 2] : Untinted;
}
}

vtkStandardNewMacro(EvidenceLegend);

EvidenceLegend::EvidenceLegend()
{
  this->PickableOff();
  this->UseBoundsOff();
  for (auto& line : this->Lines)
  {
    line->GetPositionCoordinate()->SetCoordinateSystemToViewport();
    vtkTextProperty* text = line->GetTextProperty();
    text->SetFontSize(FontSize);
    text->SetBold(true);
    text->SetJustificationToRight();
    text->SetVerticalJustificationToTop();
  }
}

EvidenceLegend::~EvidenceLegend() = default;

// The largest letters with which it is at the right of the letter of the upper edge, and above that
// of the right one.
void EvidenceLegend::Fit(vtkViewport* viewport, Shown shown)
{
  const int* size = viewport->GetSize();
  const int dpi = viewport->GetVTKWindow()->GetDPI();
  const std::array<int, 4> fitted = { size[0], size[1], dpi, static_cast<int>(shown) };
  if (fitted == this->Fitted)
  {
    return;
  }
  this->Fitted = fitted;
  glm::dvec2 extent(0.0);
  for (const std::string& words : wordsOf(shown))
  {
    vtkNew<WindowText> line;
    line->GetTextProperty()->ShallowCopy(this->Lines[0]->GetTextProperty());
    line->GetTextProperty()->SetFontSize(FontSize);
    line->SetInput(words.c_str());
    glm::dvec2 own(0.0);
    words.empty() ? void() : line->GetSize(viewport, &own[0]);
    extent = { std::max(extent.x, own.x), extent.y + Spaced * own.y };
  }
  const double letter = LetterPoints * dpi / PointsPerInch;
  const glm::dvec2 room = (0.5 - Inset) * glm::dvec2(size[0], size[1]) - 0.5 * letter;
  const int points = WindowText::FittingSize(FontSize, extent, room);
  for (auto& line : this->Lines)
  {
    line->GetTextProperty()->SetFontSize(points);
  }
}

void EvidenceLegend::Write(vtkViewport* viewport)
{
  const Shown shown = this->Ask ? this->Ask() : Shown::Tints;
  const std::array<std::string, 5> words = wordsOf(shown);
  const int* size = viewport->GetSize();
  this->Fit(viewport, shown);
  double top = (1.0 - Inset) * size[1];
  for (std::size_t i = 0; i < this->Lines.size(); ++i)
  {
    vtkTextActor* line = this->Lines[i];
    const bool plain = i == 0 || shown == Shown::Nothing;
    const glm::vec3 swatch = swatchOf(i, shown);
    const glm::vec3 ink = plain ? glm::vec3(1.0f) : Ink;
    vtkTextProperty* text = line->GetTextProperty();
    text->SetShadow(plain); // the background may be bright
    text->SetColor(ink.x, ink.y, ink.z);
    text->SetBackgroundColor(swatch.x, swatch.y, swatch.z);
    text->SetBackgroundOpacity(plain ? 0.0 : 1.0);
    line->SetInput(words[i].c_str());
    line->SetVisibility(!words[i].empty());
    line->SetPosition((1.0 - Inset) * size[0], top);
    double extent[2] = { 0.0, 0.0 };
    if (!words[i].empty())
    {
      line->GetSize(viewport, extent);
    }
    top -= Spaced * extent[1];
  }
}

int EvidenceLegend::RenderOpaqueGeometry(vtkViewport* viewport)
{
  return guarded(this, 0, [&] {
    this->Write(viewport);
    int drawn = 0;
    for (auto& line : this->Lines)
    {
      drawn += line->GetVisibility() ? line->RenderOpaqueGeometry(viewport) : 0;
    }
    return drawn;
  });
}

int EvidenceLegend::RenderOverlay(vtkViewport* viewport)
{
  return guarded(this, 0, [&] {
    int drawn = 0;
    for (auto& line : this->Lines)
    {
      drawn += line->GetVisibility() ? line->RenderOverlay(viewport) : 0;
    }
    return drawn;
  });
}

void EvidenceLegend::ReleaseGraphicsResources(vtkWindow* window)
{
  for (auto& line : this->Lines)
  {
    line->ReleaseGraphicsResources(window);
  }
  this->Superclass::ReleaseGraphicsResources(window);
}
}

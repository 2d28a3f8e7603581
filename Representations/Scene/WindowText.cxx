// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Scene/WindowText.h"

#include "Common/Guard.h"

#include "vtkObjectFactory.h"
#include "vtkTextProperty.h"
#include "vtkViewport.h"
#include "vtkWindow.h"

#include <algorithm>

namespace brainshift
{
namespace
{
constexpr int LeastSize = 8;          // points; smaller letters cannot be read
constexpr double LegendInset = 0.015; // from the edges, fraction of the view
constexpr double LegendTop = 0.89;    // from the lower edge, fraction of the view
}

vtkStandardNewMacro(WindowText);

int WindowText::FittingSize(int most, const glm::dvec2& extent, const glm::dvec2& room)
{
  const glm::dvec2 fraction = room / glm::max(extent, glm::dvec2(1.0));
  const double least = std::min({ 1.0, fraction.x, fraction.y });
  return std::max(LeastSize, static_cast<int>(most * least));
}

void WindowText::Fit(vtkViewport* viewport)
{
  constexpr double pointsPerInch = 72.0;
  const int* size = viewport->GetSize();
  const glm::dvec2 room = this->Room({ size[0], size[1] }, this->Dpi / pointsPerInch);
  vtkTextProperty* text = this->GetTextProperty();
  const std::string words = this->GetInput() ? this->GetInput() : "";
  if (room != this->Fitted || words != this->FittedText)
  {
    this->Fitted = room;
    this->FittedText = words;
    this->Size = this->Size ? this->Size : text->GetFontSize();
    text->SetFontSize(this->Size);
    glm::dvec2 extent(0.0);
    this->GetSize(viewport, &extent[0]);
    text->SetFontSize(FittingSize(this->Size, extent, room));
  }
}

int WindowText::RenderOpaqueGeometry(vtkViewport* viewport)
{
  return guarded(this, 0, [&] {
    vtkWindow* window = viewport->GetVTKWindow();
    const int* tiles = window->GetTileScale();
    if (window->GetDPI() != this->Dpi || !std::equal(tiles, tiles + 2, this->Tiles))
    {
      this->Dpi = window->GetDPI();
      std::copy_n(tiles, 2, this->Tiles);
      this->GetTextProperty()->Modified();
    }
    if (this->Room)
    {
      this->Fit(viewport);
    }
    return this->Superclass::RenderOpaqueGeometry(viewport);
  });
}

glm::dvec2 placeLegend(
  vtkTextActor* legend, const glm::dvec2& view, double point, bool hasOtherAtRight)
{
  const double letter = LetterPoints * point;
  const double top = std::min(LegendTop * view.y, (1.0 - LegendInset) * view.y - letter);
  legend->SetPosition(LegendInset, top / view.y);
  const double right = hasOtherAtRight ? 0.5 * (view.x - letter) : (1.0 - LegendInset) * view.x;
  return { right - LegendInset * view.x, top - 0.5 * (view.y + letter) };
}
}

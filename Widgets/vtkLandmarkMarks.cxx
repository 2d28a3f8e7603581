// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLandmarkMarks.h"

#include "Common/Guard.h"
#include "Common/ScreenScale.h"

#include "vtkActor2D.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper2D.h"
#include "vtkProperty2D.h"
#include "vtkSmartPointer.h"
#include "vtkTextActor.h"
#include "vtkTextProperty.h"
#include "vtkUnsignedCharArray.h"
#include "vtkViewport.h"

#include <glm/glm.hpp>

#include <array>
#include <optional>

using namespace brainshift;

namespace
{
using Color = std::array<unsigned char, 3>;
using Style = LandmarkMark::Style;

constexpr Color Cyan{ 70, 230, 255 };
constexpr Color Orange{ 255, 150, 30 };
constexpr Color White{ 255, 255, 255 };
constexpr Color Grey{ 165, 165, 165 };
constexpr Color Black{ 0, 0, 0 };
constexpr double LinePixels = 2.0; // on a usual screen, and so the next
constexpr double HaloPixels = 4.0; // black around lines, legible on white and black tissue
constexpr double MarkPixels = 6.0; // radius of ring and cross
constexpr double WorstPixels = 9.0;
constexpr int TextPixels = 15;
constexpr int Corners = 20; // of a ring

// Lines in pixels of the viewport.
struct Lines
{
  vtkNew<vtkPolyData> Shape;
  vtkNew<vtkPolyDataMapper2D> Mapper;
  vtkNew<vtkActor2D> Actor;
  vtkSmartPointer<vtkUnsignedCharArray> Colors;

  Lines()
  {
    this->Mapper->SetInputData(this->Shape);
    this->Actor->SetMapper(this->Mapper);
  }

  void clear()
  {
    this->Shape->Initialize();
    this->Shape->SetPoints(vtkNew<vtkPoints>());
    this->Shape->SetLines(vtkNew<vtkCellArray>());
    this->Colors = vtkSmartPointer<vtkUnsignedCharArray>::New();
    this->Colors->SetNumberOfComponents(3);
    this->Shape->GetCellData()->SetScalars(this->Colors);
  }

  void add(const glm::dvec2& from, const glm::dvec2& to, const Color& color)
  {
    vtkPoints* points = this->Shape->GetPoints();
    const vtkIdType ends[2] = { points->InsertNextPoint(from.x, from.y, 0.0),
      points->InsertNextPoint(to.x, to.y, 0.0) };
    this->Shape->GetLines()->InsertNextCell(2, ends);
    this->Colors->InsertNextTypedTuple(color.data());
  }
};

// Nothing behind the camera.
std::optional<glm::dvec2> pixelOf(vtkViewport* viewport, const std::optional<glm::dvec3>& position)
{
  if (!position)
  {
    return {};
  }
  viewport->SetWorldPoint(position->x, position->y, position->z, 1.0);
  viewport->WorldToDisplay();
  const double* display = viewport->GetDisplayPoint();
  if (!(display[2] >= 0.0 && display[2] <= 1.0))
  {
    return {};
  }
  const int* origin = viewport->GetOrigin();
  return glm::dvec2(display[0] - origin[0], display[1] - origin[1]);
}
}

struct vtkLandmarkMarks::Parts
{
  std::vector<LandmarkMark> Marks;
  Lines Halos;
  Lines Inks;
  std::vector<vtkSmartPointer<vtkTextActor>> Texts;

  void line(const glm::dvec2& from, const glm::dvec2& to, const Color& color)
  {
    this->Halos.add(from, to, Black);
    this->Inks.add(from, to, color);
  }

  void ring(const glm::dvec2& middle, double radius, const Color& color)
  {
    const auto corner = [&](int i) {
      const double angle = glm::radians(360.0 * i / Corners);
      return middle + radius * glm::dvec2(glm::cos(angle), glm::sin(angle));
    };
    for (int i = 0; i < Corners; ++i)
    {
      this->line(corner(i), corner(i + 1), color);
    }
  }

  void cross(const glm::dvec2& middle, double radius, const Color& color)
  {
    this->line(middle + glm::dvec2(-radius, -radius), middle + glm::dvec2(radius, radius), color);
    this->line(middle + glm::dvec2(-radius, radius), middle + glm::dvec2(radius, -radius), color);
  }

  // VTK makes letters larger where a pixel is smaller.
  void write(vtkTextActor* text, const LandmarkMark& mark, const glm::dvec2& at)
  {
    const bool isWorst = mark.style == Style::Worst;
    text->SetInput((mark.text + (isWorst ? "!" : "")).c_str());
    text->SetDisplayPosition(static_cast<int>(at.x), static_cast<int>(at.y));
    vtkTextProperty* font = text->GetTextProperty();
    font->SetFontSize(TextPixels);
    font->SetBold(isWorst);
    font->SetShadow(1);
    const Color& color = mark.style == Style::Off ? Grey : White;
    font->SetColor(color[0] / 255.0, color[1] / 255.0, color[2] / 255.0);
  }

  void draw(const LandmarkMark& mark, vtkViewport* viewport, double scale)
  {
    const double radius = scale * (mark.style == Style::Worst ? WorstPixels : MarkPixels);
    const bool isOff = mark.style == Style::Off;
    const auto tissue = pixelOf(viewport, mark.tissue);
    const auto measured = pixelOf(viewport, mark.measured);
    const auto fitted = pixelOf(viewport, mark.fitted);
    if (measured && fitted)
    {
      this->line(*measured, *fitted, isOff ? Grey : White);
    }
    if (tissue)
    {
      this->ring(*tissue, radius, isOff ? Grey : Cyan);
    }
    if (measured)
    {
      this->cross(*measured, radius * 0.7, isOff ? Grey : Orange);
    }
    if (tissue || measured)
    {
      this->Texts.push_back(vtkSmartPointer<vtkTextActor>::New());
      this->write(this->Texts.back(), mark, (tissue ? *tissue : *measured) + 1.2 * radius);
    }
  }
};

vtkStandardNewMacro(vtkLandmarkMarks);

vtkLandmarkMarks::vtkLandmarkMarks()
  : Internal(std::make_unique<Parts>())
{
  this->PickableOff();
}

vtkLandmarkMarks::~vtkLandmarkMarks() = default;

void vtkLandmarkMarks::SetMarks(const std::vector<LandmarkMark>& marks)
{
  if (!(marks == this->Internal->Marks))
  {
    this->Internal->Marks = marks;
    this->Modified();
  }
}

const std::vector<LandmarkMark>& vtkLandmarkMarks::GetMarks() const
{
  return this->Internal->Marks;
}

void vtkLandmarkMarks::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Internal->Halos.Actor->ReleaseGraphicsResources(window);
  this->Internal->Inks.Actor->ReleaseGraphicsResources(window);
  for (vtkTextActor* text : this->Internal->Texts)
  {
    text->ReleaseGraphicsResources(window);
  }
  this->Superclass::ReleaseGraphicsResources(window);
}

int vtkLandmarkMarks::RenderOverlay(vtkViewport* viewport)
{
  return guarded(this, 0, [&] {
    Parts& parts = *this->Internal;
    const double scale = screenScale(viewport->GetVTKWindow());
    for (vtkTextActor* text : parts.Texts)
    {
      text->ReleaseGraphicsResources(viewport->GetVTKWindow());
    }
    parts.Texts.clear();
    parts.Halos.clear();
    parts.Inks.clear();
    for (const LandmarkMark& mark : parts.Marks)
    {
      parts.draw(mark, viewport, scale);
    }
    if (parts.Texts.empty())
    {
      return 0;
    }
    parts.Halos.Actor->GetProperty()->SetLineWidth(static_cast<float>(HaloPixels * scale));
    parts.Inks.Actor->GetProperty()->SetLineWidth(static_cast<float>(LinePixels * scale));
    parts.Halos.Actor->RenderOverlay(viewport);
    parts.Inks.Actor->RenderOverlay(viewport);
    for (vtkTextActor* text : parts.Texts)
    {
      text->RenderOpaqueGeometry(viewport); // makes its picture
      text->RenderOverlay(viewport);
    }
    return 1;
  });
}

void vtkLandmarkMarks::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  for (const LandmarkMark& mark : this->Internal->Marks)
  {
    os << indent << "Mark : " << mark.text << (mark.tissue ? " ring" : "")
       << (mark.measured ? " cross" : "") << (mark.fitted ? " line" : "")
       << (mark.style == Style::Worst ? " worst" : "") << (mark.style == Style::Off ? " off" : "")
       << "\n";
  }
}

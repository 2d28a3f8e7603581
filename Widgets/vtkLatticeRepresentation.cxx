// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLatticeRepresentation.h"

#include "Common/Guard.h"
#include "Common/ScreenScale.h"

#include "vtkActor.h"
#include "vtkBoundingBox.h"
#include "vtkCellArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkPolyDataMapper.h"
#include "vtkPropCollection.h"
#include "vtkProperty.h"
#include "vtkViewport.h"

#include <array>

using namespace brainshift;

namespace
{
// Something drawn in one colour.
struct Drawing
{
  vtkNew<vtkPolyData> Shape;
  vtkNew<vtkPolyDataMapper> Mapper;
  vtkNew<vtkActor> Actor;
  double Pixels = 1.0;         // on a usual screen: width of lines, diameter of points
  std::vector<Polyline> Lines; // those that are shown: most stay as they are throughout a drag

  Drawing()
  {
    this->Shape->SetPoints(vtkNew<vtkPoints>());
    this->Shape->GetPoints()->SetDataTypeToDouble();
    this->Mapper->SetInputData(this->Shape);
    this->Actor->SetMapper(this->Mapper);
    this->Actor->GetProperty()->LightingOff();
    this->Actor->VisibilityOff();
  }

  void setStyle(const std::array<double, 3>& color, double opacity, double pixels)
  {
    vtkProperty* property = this->Actor->GetProperty();
    property->SetColor(color[0], color[1], color[2]);
    property->SetOpacity(opacity);
    this->Pixels = pixels;
  }

  void scaleTo(vtkWindow* window)
  {
    const auto pixels = static_cast<float>(this->Pixels * screenScale(window));
    this->Actor->GetProperty()->SetLineWidth(pixels);
    this->Actor->GetProperty()->SetPointSize(pixels);
  }

  void clear()
  {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    this->Shape->Initialize();
    this->Shape->SetPoints(points);
    this->Shape->SetVerts(vtkNew<vtkCellArray>());
    this->Shape->SetLines(vtkNew<vtkCellArray>());
    this->Lines.clear();
    this->Actor->VisibilityOff();
  }

  vtkIdType addPoint(const glm::dvec3& at)
  {
    return this->Shape->GetPoints()->InsertNextPoint(at.x, at.y, at.z);
  }

  void show(const std::vector<glm::dvec3>& points)
  {
    this->clear();
    for (const glm::dvec3& at : points)
    {
      const vtkIdType point = this->addPoint(at);
      this->Shape->GetVerts()->InsertNextCell(1, &point);
    }
    this->done();
  }

  void show(const std::vector<Polyline>& lines)
  {
    if (lines == this->Lines)
    {
      return;
    }
    this->clear();
    for (const Polyline& line : lines)
    {
      this->Shape->GetLines()->InsertNextCell(static_cast<int>(line.size()));
      for (const glm::dvec3& point : line)
      {
        this->Shape->GetLines()->InsertCellPoint(this->addPoint(point));
      }
    }
    this->Lines = lines;
    this->done();
  }

  void done()
  {
    this->Shape->Modified();
    this->Actor->SetVisibility(this->Shape->GetNumberOfPoints() > 0);
  }
};

constexpr std::array<double, 3> Yellow{ 1.0, 0.85, 0.2 };
constexpr std::array<double, 3> White{ 0.95, 0.95, 0.95 };
constexpr std::array<double, 3> Orange{ 1.0, 0.45, 0.05 };
constexpr std::array<double, 3> Cyan{ 0.2, 0.9, 1.0 };
constexpr std::array<double, 3> Green{ 0.3, 0.95, 0.35 };
constexpr double PointPixels = 7.0; // below 5, users of trackpads miss it
constexpr double HighlightPixels = 12.0;
constexpr double FaintPixels = 3.0;
}

struct vtkLatticeRepresentation::Parts
{
  std::vector<ControlPoint> ControlPoints;
  Drawing Edges;
  Drawing Faint;
  Drawing Points;
  Drawing Dots;
  Drawing Highlights;
  std::array<Drawing, NumberOfPens> Lines;

  std::vector<Drawing*> all()
  {
    std::vector<Drawing*> drawings{ &this->Edges, &this->Faint };
    for (Drawing& lines : this->Lines)
    {
      drawings.push_back(&lines);
    }
    drawings.push_back(&this->Points);
    drawings.push_back(&this->Dots);
    drawings.push_back(&this->Highlights);
    return drawings;
  }
};

vtkStandardNewMacro(vtkLatticeRepresentation);

vtkLatticeRepresentation::vtkLatticeRepresentation()
  : Internal(std::make_unique<Parts>())
{
  Parts& parts = *this->Internal;
  parts.Edges.setStyle(White, 0.35, 1.0);
  parts.Faint.setStyle(White, 0.5, FaintPixels);
  parts.Points.setStyle(White, 1.0, PointPixels);
  parts.Points.Actor->GetProperty()->RenderPointsAsSpheresOn();
  parts.Dots.setStyle(White, 1.0, PointPixels);
  parts.Dots.Actor->GetProperty()->RenderPointsAsSpheresOn();
  parts.Highlights.setStyle(Orange, 1.0, HighlightPixels);
  parts.Highlights.Actor->GetProperty()->RenderPointsAsSpheresOn();
  parts.Lines[Strong].setStyle(Yellow, 1.0, 2.0);
  parts.Lines[Weak].setStyle(Yellow, 0.4, 1.0);
  parts.Lines[Mark].setStyle(Cyan, 1.0, 2.0);
  parts.Lines[Hold].setStyle(Green, 1.0, 2.5);
}

vtkLatticeRepresentation::~vtkLatticeRepresentation() = default;

void vtkLatticeRepresentation::SetControlPoints(const std::vector<ControlPoint>& points)
{
  Parts& parts = *this->Internal;
  parts.ControlPoints = points;
  parts.Points.clear();
  parts.Edges.clear();
  for (const ControlPoint& point : points)
  {
    const vtkIdType added = parts.Points.addPoint(point.drawn);
    parts.Points.Shape->GetVerts()->InsertNextCell(1, &added);
    parts.Edges.addPoint(point.drawn);
  }
  for (const auto& [first, second] : edgesBetween(points))
  {
    const vtkIdType ends[2] = { first, second };
    parts.Edges.Shape->GetLines()->InsertNextCell(2, ends);
  }
  parts.Points.done();
  parts.Edges.done();
  this->Modified();
}

const std::vector<ControlPoint>& vtkLatticeRepresentation::GetControlPoints() const
{
  return this->Internal->ControlPoints;
}

void vtkLatticeRepresentation::SetFaint(const std::vector<glm::dvec3>& positions)
{
  this->Internal->Faint.show(positions);
  this->Modified();
}

void vtkLatticeRepresentation::SetHighlights(const std::vector<glm::dvec3>& positions)
{
  this->Internal->Highlights.show(positions);
  this->Modified();
}

void vtkLatticeRepresentation::SetDots(const std::vector<glm::dvec3>& positions)
{
  this->Internal->Dots.show(positions);
  this->Modified();
}

void vtkLatticeRepresentation::SetLines(Pen pen, const std::vector<Polyline>& lines)
{
  this->Internal->Lines[pen].show(lines);
  this->Modified();
}

void vtkLatticeRepresentation::Clear()
{
  this->Internal->ControlPoints.clear();
  for (Drawing* drawing : this->Internal->all())
  {
    drawing->clear();
  }
  this->Modified();
}

int vtkLatticeRepresentation::GetNumberOfControlPoints() const
{
  return static_cast<int>(this->Internal->ControlPoints.size());
}

int vtkLatticeRepresentation::GetNumberOfFaint() const
{
  return static_cast<int>(this->Internal->Faint.Shape->GetNumberOfPoints());
}

int vtkLatticeRepresentation::GetNumberOfHighlights() const
{
  return static_cast<int>(this->Internal->Highlights.Shape->GetNumberOfPoints());
}

int vtkLatticeRepresentation::GetNumberOfDots() const
{
  return static_cast<int>(this->Internal->Dots.Shape->GetNumberOfPoints());
}

int vtkLatticeRepresentation::GetNumberOfLines(int pen) const
{
  const bool known = pen >= 0 && pen < NumberOfPens;
  return known ? static_cast<int>(this->Internal->Lines[pen].Shape->GetNumberOfLines()) : 0;
}

void vtkLatticeRepresentation::BuildRepresentation() {} // what is drawn is set, not derived

double* vtkLatticeRepresentation::GetBounds()
{
  vtkBoundingBox box;
  for (Drawing* drawing : this->Internal->all())
  {
    if (drawing->Actor->GetVisibility())
    {
      box.AddBounds(drawing->Shape->GetBounds()); // the actor would update its mapper's pipeline
    }
  }
  if (!box.IsValid())
  {
    return nullptr;
  }
  box.GetBounds(this->Box);
  return this->Box;
}

void vtkLatticeRepresentation::GetActors(vtkPropCollection* actors)
{
  for (Drawing* drawing : this->Internal->all())
  {
    drawing->Actor->GetActors(actors);
  }
}

void vtkLatticeRepresentation::ReleaseGraphicsResources(vtkWindow* window)
{
  for (Drawing* drawing : this->Internal->all())
  {
    drawing->Actor->ReleaseGraphicsResources(window);
  }
  this->Superclass::ReleaseGraphicsResources(window);
}

int vtkLatticeRepresentation::RenderOpaqueGeometry(vtkViewport* viewport)
{
  return guarded(this, 0, [&] {
    int rendered = 0;
    for (Drawing* drawing : this->Internal->all())
    {
      drawing->scaleTo(viewport->GetVTKWindow());
      rendered +=
        drawing->Actor->GetVisibility() ? drawing->Actor->RenderOpaqueGeometry(viewport) : 0;
    }
    return rendered;
  });
}

int vtkLatticeRepresentation::RenderOverlay(vtkViewport* viewport)
{
  return guarded(this, 0, [&] {
    int rendered = 0;
    for (Drawing* drawing : this->Internal->all())
    {
      rendered += drawing->Actor->GetVisibility()
        ? drawing->Actor->RenderTranslucentPolygonalGeometry(viewport)
        : 0;
    }
    return rendered;
  });
}

void vtkLatticeRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ControlPoints: " << this->GetNumberOfControlPoints() << "\n"
     << indent << "Faint: " << this->GetNumberOfFaint() << "\n"
     << indent << "Highlights: " << this->GetNumberOfHighlights() << "\n"
     << indent << "Dots: " << this->GetNumberOfDots() << "\n"
     << indent << "Held: " << this->GetNumberOfLines(Hold) << "\n";
}

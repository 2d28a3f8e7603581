// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLatticeReport.h"

#include "Common/FilledArray.h"
#include "Common/Guard.h"
#include "Common/Problem.h"
#include "Filters/Attached/DeformableVolume.h"
#include "Filters/Deformation/ControlPoints.h"

#include "vtkAlgorithm.h"
#include "vtkDataObject.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkObjectFactory.h"

using namespace brainshift;

namespace
{
constexpr int components = 9; // of a control point

// What the output carries (DeformableVolume.h), read in place: its displacements, or null if it
// carries nothing.
vtkFloatArray* readDrawn(vtkAlgorithm* filter, DrawnLattice& lattice)
{
  vtkDataObject* output = filter ? filter->GetOutputDataObject(0) : nullptr;
  vtkFieldData* fields = output ? output->GetFieldData() : nullptr;
  const auto array = [&](const char* name) { return fields ? fields->GetArray(name) : nullptr; };
  auto displacements = vtkFloatArray::SafeDownCast(array("FFDDisplacements"));
  vtkDataArray* dimensions = array("FFDDimensions");
  vtkDataArray* box = array("FFDBox");
  vtkDataArray* strength = array("FFDStrength");
  if (!displacements || !dimensions || !box || !strength || dimensions->GetNumberOfValues() != 3 ||
    box->GetNumberOfValues() != 15)
  {
    return nullptr;
  }
  double numbers[15];
  for (int i = 0; i < 15; ++i)
  {
    numbers[i] = box->GetVariantValue(i).ToDouble();
  }
  setBox(lattice.grid, numbers);
  for (int axis = 0; axis < 3; ++axis)
  {
    lattice.grid.dimensions[axis] = dimensions->GetVariantValue(axis).ToInt();
  }
  lattice.displacements = displacements->GetPointer(0);
  lattice.strength = strength->GetVariantValue(0).ToDouble();
  const bool complete =
    static_cast<std::size_t>(displacements->GetNumberOfValues()) == 3 * lattice.grid.count();
  return complete ? displacements : nullptr;
}
}

vtkStandardNewMacro(vtkLatticeReport);

vtkLatticeReport::vtkLatticeReport() = default;
vtkLatticeReport::~vtkLatticeReport() = default;

void vtkLatticeReport::SetFilter(vtkAlgorithm* filter)
{
  this->Filter = filter;
}

void vtkLatticeReport::SetCone(const double cone[8])
{
  std::copy_n(cone, 8, this->Cone);
}

void vtkLatticeReport::SetSlab(const double slab[7])
{
  std::copy_n(slab, 7, this->Slab);
}

void vtkLatticeReport::FindFarthest(vtkFloatArray* displacements, DrawnLattice& lattice)
{
  if (displacements != this->Known || displacements->GetMTime() != this->KnownTime)
  {
    this->Known = displacements;
    this->KnownTime = displacements->GetMTime();
    this->Farthest = longest(lattice);
  }
  lattice.farthest = this->Farthest;
}

vtkDoubleArray* vtkLatticeReport::GetControlPoints()
{
  this->ControlPoints->Reset();
  this->ControlPoints->SetNumberOfComponents(components);
  DrawnLattice lattice;
  vtkFloatArray* displacements = readDrawn(this->Filter, lattice);
  if (displacements)
  {
    guarded(this, [&] { this->ListControlPoints(displacements, lattice); });
  }
  return this->ControlPoints;
}

void vtkLatticeReport::ListControlPoints(vtkFloatArray* displacements, DrawnLattice& lattice)
{
  this->FindFarthest(displacements, lattice);
  ControlPointSet offsets;
  const glm::dvec3 centre(this->Ball[0], this->Ball[1], this->Ball[2]);
  const double* plane = this->Slab;
  const brainshift::Slab slab{ { plane[0], plane[1], plane[2] }, { plane[3], plane[4], plane[5] },
    plane[6] };
  if (this->Ball[3] > 0.0)
  {
    addInBall(lattice, centre, this->Ball[3], slab, offsets);
  }
  const double* cone = this->Cone;
  if (cone[6] > 0.0 || cone[7] > 0.0)
  {
    addInCone(lattice,
      { { cone[0], cone[1], cone[2] }, { cone[3], cone[4], cone[5] }, cone[6], cone[7] }, offsets);
  }
  if (this->MovedWithin > 0.0)
  {
    addMoved(lattice, centre, this->MovedWithin, slab, offsets);
  }
  for (std::size_t offset : offsets)
  {
    const glm::ivec3 index = indexOf(lattice.grid, offset);
    const glm::dvec3 rest = lattice.rest(index);
    const glm::dvec3 drawn = lattice.deformed(index);
    const double tuple[components] = { static_cast<double>(index.x), static_cast<double>(index.y),
      static_cast<double>(index.z), rest.x, rest.y, rest.z, drawn.x, drawn.y, drawn.z };
    this->ControlPoints->InsertNextTuple(tuple);
  }
}

vtkDoubleArray* vtkLatticeReport::GetGeometry()
{
  this->Geometry->Reset();
  DrawnLattice lattice;
  if (readDrawn(this->Filter, lattice))
  {
    append(this->Geometry, glm::dvec3(lattice.grid.dimensions));
    for (const double number : boxOf(lattice.grid))
    {
      this->Geometry->InsertNextValue(number);
    }
  }
  return this->Geometry;
}

void vtkLatticeReport::AddPlace(double x, double y, double z)
{
  this->Places.insert(this->Places.end(), { x, y, z });
}

void vtkLatticeReport::ClearPlaces()
{
  this->Places.clear();
}

vtkDoubleArray* vtkLatticeReport::GetSameTissue()
{
  this->SameTissue->Reset();
  guarded(this, [&] { this->FindSameTissue(); });
  return this->SameTissue;
}

void vtkLatticeReport::FindSameTissue()
{
  vtkDataObject* output = this->Filter ? this->Filter->GetOutputDataObject(0) : nullptr;
  const unsigned long long time = carriesDeformation(output) ? deformationTime(output) : 0;
  if (time != this->MapTime)
  {
    this->Map = nullptr;
    this->MapTime = time;
    problemOf([&] { // without a deformation there are no answers
      const Deformation deformation = readDeformation(output);
      this->Map = std::make_unique<PointMap>(effectiveLattice(deformation), deformation.inverse);
    });
  }
  for (std::size_t i = 0; this->Map && i + 2 < this->Places.size(); i += 3)
  {
    const glm::dvec3 place(this->Places[i], this->Places[i + 1], this->Places[i + 2]);
    append(this->SameTissue,
      this->ToRest ? this->Map->restFromDeformed(place) : this->Map->deformedFromRest(place));
  }
}

void vtkLatticeReport::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Ball: " << this->Ball[0] << " " << this->Ball[1] << " " << this->Ball[2] << " "
     << this->Ball[3] << "\n"
     << indent << "MovedWithin: " << this->MovedWithin << "\n"
     << indent << "Places: " << this->Places.size() / 3 << "\n"
     << indent << "ToRest: " << this->ToRest << "\n";
}

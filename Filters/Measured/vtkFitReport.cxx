// SPDX-License-Identifier: BSD-3-Clause
#include "vtkFitReport.h"

#include "Common/FilledArray.h"
#include "Common/Guard.h"
#include "vtkFitDeformation.h"

#include "vtkObjectFactory.h"

using namespace brainshift;

vtkStandardNewMacro(vtkFitReport);

vtkFitReport::vtkFitReport() = default;
vtkFitReport::~vtkFitReport() = default;

void vtkFitReport::SetFilter(vtkObject* filter)
{
  this->Filter = vtkFitDeformation::SafeDownCast(filter);
}

void vtkFitReport::AddPoint(double x, double y, double z)
{
  this->Points.insert(this->Points.end(), { x, y, z });
}

void vtkFitReport::ClearPoints()
{
  this->Points.clear();
}

vtkDoubleArray* vtkFitReport::GetMeasured()
{
  this->Measured->Reset();
  if (this->Filter)
  {
    guarded(this, [&] { filled(this->Measured, this->Filter->MeasuredFromRest(this->Points)); });
  }
  return this->Measured;
}

vtkDoubleArray* vtkFitReport::GetDeviations()
{
  this->Deviations->Reset();
  if (this->Filter)
  {
    guarded(this, [&] { filled(this->Deviations, this->Filter->Deviations(this->Points)); });
  }
  return this->Deviations;
}

vtkDoubleArray* vtkFitReport::GetRows()
{
  this->Rows->Reset();
  if (this->Filter)
  {
    guarded(this, [&] { filled(this->Rows, this->Filter->Rows()); });
  }
  return this->Rows;
}

vtkDoubleArray* vtkFitReport::GetCovariance()
{
  this->Covariance->Reset();
  if (this->Filter)
  {
    guarded(this, [&] { filled(this->Covariance, this->Filter->Covariance()); });
  }
  return this->Covariance;
}

void vtkFitReport::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Points: " << this->Points.size() / 3 << "\n";
}

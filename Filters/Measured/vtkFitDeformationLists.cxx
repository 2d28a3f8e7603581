// SPDX-License-Identifier: BSD-3-Clause
// The properties of a fit that are lists.
#include "vtkFitDeformation.h"

#include "Filters/Measured/FitLandmarks.h"

void vtkFitDeformation::AddMaskLabel(int label)
{
  this->MaskLabels.push_back(label);
  this->Modified();
}

void vtkFitDeformation::ClearMaskLabels()
{
  this->MaskLabels.clear();
  this->Modified();
}

void vtkFitDeformation::AddPull(double number)
{
  this->Pulls.push_back(number);
  this->Modified();
}

void vtkFitDeformation::ClearPulls()
{
  this->Pulls.clear();
  this->Modified();
}

void vtkFitDeformation::AddPin(double number)
{
  this->Pins.push_back(number);
  this->Modified();
}

void vtkFitDeformation::ClearPins()
{
  this->Pins.clear();
  this->Modified();
}

void vtkFitDeformation::AddLandmarkPair(double number)
{
  this->Landmarks->Numbers.push_back(number);
  this->Modified();
}

void vtkFitDeformation::ClearLandmarkPairs()
{
  this->Landmarks->Numbers.clear();
  this->Modified();
}

void vtkFitDeformation::AddLandmarkOff(const char* name)
{
  this->Landmarks->SwitchedOff.emplace_back(name ? name : "");
  this->Modified();
}

void vtkFitDeformation::ClearLandmarksOff()
{
  this->Landmarks->SwitchedOff.clear();
  this->Modified();
}

vtkStringArray* vtkFitDeformation::GetLandmarkNames()
{
  return this->Landmarks->Names;
}

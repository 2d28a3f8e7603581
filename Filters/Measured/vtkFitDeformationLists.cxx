// SPDX-License-Identifier: BSD-3-Clause
// The properties of a fit that are lists, and what it prints.
#include "vtkFitDeformation.h"

#include "Filters/Fit/PackedTables.h"
#include "Filters/Measured/FitLandmarks.h"

using namespace brainshift;

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

void vtkFitDeformation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "LatticeDimensions: " << this->LatticeDimensions[0] << " "
     << this->LatticeDimensions[1] << " " << this->LatticeDimensions[2] << "\n"
     << indent << "Kernel: " << (this->Kernel ? "B-Spline" : "Catmull-Rom") << "\n"
     << indent << "Samples: " << this->Samples << "\n"
     << indent << "GuardFolding: " << this->GuardFolding << "\n"
     << indent << "Live: " << this->Live << "\n"
     << indent << "SurfaceArray: " << this->SurfaceArray << "\n"
     << indent << "SurfaceBy: " << (this->SurfaceBy ? "Label" : "Threshold") << "\n"
     << indent << "Threshold: " << this->Threshold << "\n"
     << indent << "Label: " << this->Label << "\n"
     << indent << "Anchors: " << this->Anchors << "\n"
     << indent << "OpeningRadius: " << this->OpeningRadius << "\n"
     << indent << "Evidence: " << this->Evidence << "\n"
     << indent << "Feather: " << this->Feather << "\n"
     << indent << "MaskGrowth: " << this->MaskGrowth << "\n"
     << indent << "LandmarkPairs: " << this->Landmarks->Numbers.size() / Packed<PointPair>::Numbers
     << "\n"
     << indent << "Pulls: " << this->Pulls.size() / Packed<Pull>::Numbers << "\n"
     << indent << "Pins: " << this->Pins.size() / Packed<Pin>::Numbers << "\n";
}

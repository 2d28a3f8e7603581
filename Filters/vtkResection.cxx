// SPDX-License-Identifier: BSD-3-Clause
#include "vtkResection.h"

#include "Common/Guard.h"
#include "Common/ImageGrid.h"
#include "Common/SharedArray.h"
#include "Common/WorldAxes.h"
#include "Filters/Attached/MaskImage.h"
#include "Filters/Attached/Resection.h"

#include "vtkCellData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"

using namespace brainshift;

namespace
{
constexpr int TumourPort = 1;
constexpr int CavityPort = 2;
constexpr int Ports = 3;

// What is wrong with the sides of an input, or nothing.
void addWordsOnSides(
  std::string& words, const char* noun, vtkImageData* guest, vtkDataObject* volume)
{
  const std::string added =
    guest ? wordsOnSidesOf(namedAxesOf(noun, guest), volume) : std::string();
  words += (words.empty() || added.empty() ? "" : ". ") + added;
}
}

// Hands out one array object for one input, so that what holds it on the GPU knows it again.
struct vtkResection::Kept
{
  SharedArrays PointArrays;
  SharedArrays CellArrays;
  CavitySource Tumour;
  CavitySource Cavity;
  RenamedArray TumourVoxels;
  RenamedArray RemovedVoxels;
  std::string Warning;
};

vtkStandardNewMacro(vtkResection);
brainshiftGuardRequestsMacro(vtkResection);

vtkResection::vtkResection()
  : Internal(std::make_unique<Kept>())
{
  this->SetNumberOfInputPorts(Ports);
}

vtkResection::~vtkResection() = default;

void vtkResection::SetTumourConnection(vtkAlgorithmOutput* tumour)
{
  this->SetInputConnection(TumourPort, tumour);
}

void vtkResection::SetCavityConnection(vtkAlgorithmOutput* cavity)
{
  this->SetInputConnection(CavityPort, cavity);
}

void vtkResection::AddTumourLabel(int label)
{
  this->TumourLabels.push_back(label);
  this->Modified();
}

void vtkResection::ClearTumourLabels()
{
  this->TumourLabels.clear();
  this->Modified();
}

void vtkResection::AddCavityLabel(int label)
{
  this->CavityLabels.push_back(label);
  this->Modified();
}

void vtkResection::ClearCavityLabels()
{
  this->CavityLabels.clear();
  this->Modified();
}

int vtkResection::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), port != 0);
  return 1;
}

int vtkResection::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  // The volume passes through in the pieces that are asked for.
  for (const int port : { TumourPort, CavityPort })
  {
    updateWholeExtent(inputs[port]->GetInformationObject(0));
  }
  return 1;
}

int vtkResection::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  Kept& kept = *this->Internal;
  vtkImageData* output = vtkImageData::GetData(outputs);
  output->ShallowCopy(vtkImageData::GetData(inputs[0]));
  kept.PointArrays.share(output->GetPointData());
  kept.CellArrays.share(output->GetCellData());
  const Grid grid = gridOf(output);
  requirePosition(grid, "The volume's ");
  vtkImageData* tumour = vtkImageData::GetData(inputs[TumourPort]);
  vtkImageData* cavity = vtkImageData::GetData(inputs[CavityPort]);
  Resection found{ kept.Tumour.find(
                     tumour, this->TumourLabels, grid, { "tumour", "volume", "TumourLabels" }),
    kept.Cavity.find(cavity, this->CavityLabels, grid, { "cavity", "volume", "CavityLabels" }) };
  if (!found.cavity.voxels)
  {
    found.cavity = readReference(output).cavity;
  }
  if (!found.tumour.voxels && !found.cavity.voxels)
  {
    throw Problem("Resection has neither a tumour nor a cavity: choose one of them, or give it a "
                  "Compare Volumes that has a Cavity");
  }
  if (!this->RemoveTissue)
  {
    found.cavity.voxels = nullptr;
  }
  found.tumour.voxels = kept.TumourVoxels.as(TumourVoxelsName, found.tumour.voxels);
  found.cavity.voxels = kept.RemovedVoxels.as(RemovedVoxelsName, found.cavity.voxels);
  removeReference(output);
  attachResection(output, found);
  std::string words;
  addWordsOnSides(words, "the tumour", tumour, output);
  addWordsOnSides(words, "the cavity", cavity, output);
  warnAnew(this, words, kept.Warning);
  return 1;
}

std::string vtkResection::GetWarning() const
{
  return this->Internal->Warning;
}

void vtkResection::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "RemoveTissue: " << this->RemoveTissue << "\n"
     << indent << "TumourLabels: " << this->TumourLabels.size() << "\n"
     << indent << "CavityLabels: " << this->CavityLabels.size() << "\n";
}

// SPDX-License-Identifier: BSD-3-Clause
#include "vtkCompareVolumes.h"

#include "Common/Guard.h"
#include "Common/ImageGrid.h"
#include "Common/LabelTable.h"
#include "Common/SharedArray.h"
#include "Common/WorldAxes.h"
#include "Filters/Attached/DeformableVolume.h"
#include "Filters/Attached/MaskImage.h"

#include "vtkCellData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"

using namespace brainshift;

namespace
{
constexpr int ReferencePort = 1;
constexpr int ComparedCavityPort = 2;
constexpr int Ports = 3;

// The scalars of the reference.
vtkDataArray* referenceScalars(vtkImageData* image)
{
  vtkDataArray* scalars = image->GetPointData()->GetScalars();
  scalars = scalars ? scalars : image->GetPointData()->GetArray(0);
  const int components = scalars ? scalars->GetNumberOfComponents() : 0;
  if (components != 1)
  {
    throw Problem("The reference's point scalars have " + std::to_string(components) +
      " components; they must have 1");
  }
  return scalars;
}
}

// Hands out one array object for one input, so that what holds it on the GPU knows it again.
struct vtkCompareVolumes::Kept
{
  SharedArrays PointArrays;
  SharedArrays CellArrays;

  RenamedArray Voxels; // of the reference
  CavitySource Cavity;
  std::string Warning;
};

vtkStandardNewMacro(vtkCompareVolumes);
brainshiftGuardRequestsMacro(vtkCompareVolumes);

vtkCompareVolumes::vtkCompareVolumes()
  : Internal(std::make_unique<Kept>())
{
  this->SetNumberOfInputPorts(Ports);
}

vtkCompareVolumes::~vtkCompareVolumes() = default;

void vtkCompareVolumes::SetReferenceConnection(vtkAlgorithmOutput* reference)
{
  this->SetInputConnection(ReferencePort, reference);
}

void vtkCompareVolumes::SetCavityConnection(vtkAlgorithmOutput* cavity)
{
  this->SetInputConnection(ComparedCavityPort, cavity);
}

void vtkCompareVolumes::AddCavityLabel(int label)
{
  this->CavityLabels.push_back(label);
  this->Modified();
}

void vtkCompareVolumes::ClearCavityLabels()
{
  this->CavityLabels.clear();
  this->Modified();
}

int vtkCompareVolumes::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), port == ComparedCavityPort);
  return 1;
}

int vtkCompareVolumes::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  // The volume passes through in the pieces that are asked for.
  for (const int port : { ReferencePort, ComparedCavityPort })
  {
    updateWholeExtent(inputs[port]->GetInformationObject(0));
  }
  return 1;
}

int vtkCompareVolumes::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkImageData* output = vtkImageData::GetData(outputs);
  output->ShallowCopy(vtkImageData::GetData(inputs[0]));
  this->Internal->PointArrays.share(output->GetPointData());
  this->Internal->CellArrays.share(output->GetCellData());
  vtkImageData* image = vtkImageData::GetData(inputs[ReferencePort]);
  const Grid grid = gridOf(image);
  requirePosition(gridOf(output), "The volume's ");
  requirePosition(grid, "The reference's ");
  vtkDataArray* scalars = referenceScalars(image);
  PlacedVoxels cavity =
    this->Internal->Cavity.find(vtkImageData::GetData(inputs[ComparedCavityPort]),
      this->CavityLabels, grid, { "cavity", "reference", "CavityLabels" });
  const double* r = this->ReferenceRotation;
  const double* t = this->ReferenceTranslation;
  const RigidMotion motion{ middleOf(grid), { r[0], r[1], r[2] }, { t[0], t[1], t[2] } };
  cavity.grid = movedRigidly(cavity.grid, motion);
  attachReference(output,
    { { this->Internal->Voxels.as(ReferenceVoxelsName, scalars), movedRigidly(grid, motion) },
      cavity, static_cast<ReferenceShow>(this->Show), isLabelMap(image), {} });
  warnAnew(this,
    wordsOnSides(namedAxesOf("the volume", output), namedAxesOf("the reference", image)),
    this->Internal->Warning);
  return 1;
}

std::string vtkCompareVolumes::GetWarning() const
{
  return this->Internal->Warning;
}

void vtkCompareVolumes::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const double* r = this->ReferenceRotation;
  const double* t = this->ReferenceTranslation;
  os << indent << "ReferenceRotation: " << r[0] << " " << r[1] << " " << r[2] << "\n"
     << indent << "ReferenceTranslation: " << t[0] << " " << t[1] << " " << t[2] << "\n"
     << indent << "Show: " << this->Show << "\n"
     << indent << "CavityLabels: " << this->CavityLabels.size() << "\n";
}

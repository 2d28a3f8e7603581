// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLatticeAlgorithm.h"

#include "Filters/Attached/DeformableVolume.h"
#include "Filters/Attached/MaskImage.h"
#include "Formats/Fields/FieldImage.h"

#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

using namespace brainshift;

vtkLatticeAlgorithm::vtkLatticeAlgorithm()
  : Masks(std::make_unique<MaskSource>())
{
  this->SetNumberOfInputPorts(MaskPort + 1);
}

vtkLatticeAlgorithm::~vtkLatticeAlgorithm() = default;

void vtkLatticeAlgorithm::SetMaskConnection(vtkAlgorithmOutput* mask)
{
  this->SetInputConnection(MaskPort, mask);
}

int vtkLatticeAlgorithm::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  if (port > 0)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

Grid vtkLatticeAlgorithm::LatticeGrid(const Grid& volume) const
{
  return withDimensions(volume,
    glm::clamp(glm::make_vec3(this->LatticeDimensions), SmallestLatticeSide, LargestLatticeSide));
}

int vtkLatticeAlgorithm::AnnounceLattice(
  vtkInformationVector** inputs, vtkInformationVector* outputs) const
{
  vtkInformation* output = outputs->GetInformationObject(0);
  announce(output, this->LatticeGrid(wholeGridOf(inputs[0]->GetInformationObject(0))));
  output->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1);
  return 1;
}

void vtkLatticeAlgorithm::RequireSettings() const
{
  requireLatticeSides(glm::make_vec3(this->LatticeDimensions));
  std::ostringstream words;
  if (this->Samples < SmallestSamples || this->Samples > LargestSamples)
  {
    words << "Samples is " << this->Samples << "; it must be from " << SmallestSamples << " to "
          << LargestSamples;
    throw Problem(words.str());
  }
  const auto isLength = [](double mm) { return mm >= 0.0 && std::isfinite(mm); };
  if (!isLength(this->Feather))
  {
    words << "Feather is " << this->Feather << " mm; it must be 0 or more, and finite";
    throw Problem(words.str());
  }
  if (!isLength(this->MaskGrowth) && this->MaskGrowth != ByFeather)
  {
    words << "Mask Growth is " << this->MaskGrowth << " mm; it must be 0 or more, and finite, or "
          << ByFeather << " for what Feather needs";
    throw Problem(words.str());
  }
}

namespace
{
constexpr double MostCellsMm = 12.0; // enough for a head of 256 mm and the default lattice

// Mask Growth (mm) by the width of the feather, so that all tissue in the mask has the whole
// displacement. Nodes of the refined field beside the edge are held, the field is trilinear between
// nodes, and the mask grows by whole voxels: each can take the diagonal of a cell. Without these, a
// brain under its mask sank by 87 % of what was measured at the cortex.
double growthBy(double featherMm, const Grid& lattice, int samples, vtkImageData* mask)
{
  const double cell = glm::length(lattice.spacing) / (samples + 1.0);
  const double voxel = mask ? glm::length(glm::make_vec3(mask->GetSpacing())) : 0.0;
  return featherMm + std::min(2.0 * cell + voxel, MostCellsMm);
}
}

Lattice vtkLatticeAlgorithm::MakeLattice(const Grid& volume, vtkImageData* mask)
{
  this->RequireSettings();
  Lattice lattice = makeLattice(this->LatticeGrid(volume), this->Kernel);
  const double growth = this->MaskGrowth == ByFeather
    ? growthBy(this->Feather, lattice.grid, this->Samples, mask)
    : this->MaskGrowth;
  lattice.mask = this->Masks->find(
    { mask, this->MaskLabels, growth, this->Feather, volume, lattice.grid, this->Samples });
  return lattice;
}

void vtkLatticeAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "LatticeDimensions: " << this->LatticeDimensions[0] << " "
     << this->LatticeDimensions[1] << " " << this->LatticeDimensions[2] << "\n"
     << indent << "Samples: " << this->Samples << "\n"
     << indent << "Kernel: " << (this->Kernel ? "B-Spline" : "Catmull-Rom") << "\n"
     << indent << "Feather: " << this->Feather << "\n"
     << indent << "MaskGrowth: " << this->MaskGrowth << "\n"
     << indent << "MaskLabels: " << this->MaskLabels.size() << "\n";
}

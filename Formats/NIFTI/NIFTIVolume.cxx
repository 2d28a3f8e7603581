// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/NIFTI/NIFTIVolume.h"

#include "Formats/NIFTI/NIFTIFileCheck.h"
#include "Formats/NIFTI/NIFTIGeometry.h"
#include "Formats/NIFTI/NIFTILabels.h"
#include "Formats/Volumes/OutgoingVolume.h"

#include "vtkCommand.h"
#include "vtkExecutive.h"
#include "vtkImageData.h"
#include "vtkNIFTIImageHeader.h"

#include <cmath>

namespace brainshift
{
namespace
{
NIFTIPlacement placementOf(vtkNIFTIImageHeader* header)
{
  NIFTIPlacement placement;
  placement.sformCode = header->GetSFormCode();
  placement.qformCode = header->GetQFormCode();
  const double* const rows[3] = { header->GetSRowX(), header->GetSRowY(), header->GetSRowZ() };
  for (int row = 0; row < 3; ++row)
  {
    placement.sformRows[row] = glm::dvec4(rows[row][0], rows[row][1], rows[row][2], rows[row][3]);
  }
  placement.quaternion =
    glm::dvec3(header->GetQuaternB(), header->GetQuaternC(), header->GetQuaternD());
  placement.qformOffset =
    glm::dvec3(header->GetQOffsetX(), header->GetQOffsetY(), header->GetQOffsetZ());
  placement.pixelSize =
    glm::dvec3(header->GetPixDim(1), header->GetPixDim(2), header->GetPixDim(3));
  placement.qfac = header->GetPixDim(0);
  placement.mmPerUnit = mmPerNIFTIUnit(header->GetXYZTUnits());
  return placement;
}

// vtkNIFTIImageReader reverses the slices of left-handed files.
glm::dmat4 voxelFromReversedSlices(int slices)
{
  glm::dmat4 voxelFromReversed(1.0);
  voxelFromReversed[2][2] = -1.0;
  voxelFromReversed[3][2] = slices - 1;
  return voxelFromReversed;
}

// Seconds, one for each volume of a time series; a spacing that is no number counts as 1.
std::vector<double> timesOf(vtkNIFTIImageHeader* header)
{
  const vtkTypeInt64 count = header->GetDim(0) >= 4 ? header->GetDim(4) : 1;
  const double seconds = secondsPerNIFTIUnit(header->GetXYZTUnits());
  const double spacing = std::abs(header->GetPixDim(4));
  const double step = std::isfinite(spacing) && spacing > 0.0 ? spacing : 1.0;
  const double start = std::isfinite(header->GetTOffset()) ? header->GetTOffset() : 0.0;
  std::vector<double> times;
  times.reserve(count > 0 ? count : 0);
  for (vtkTypeInt64 i = 0; i < count; ++i)
  {
    times.push_back(seconds * (start + static_cast<double>(i) * step));
  }
  return times;
}

// Keeps the first error of an object that is not to speak to the user itself, without the name of
// its source file.
void keepError(vtkObject*, unsigned long event, void* clientData, void* callData)
{
  std::string& kept = *static_cast<std::string*>(clientData);
  if (event != vtkCommand::ErrorEvent || !kept.empty())
  {
    return;
  }
  kept = static_cast<const char*>(callData);
  const std::size_t textBegin = kept.find("): ");
  kept = textBegin == std::string::npos ? kept : kept.substr(textBegin + 3);
  kept.erase(kept.find_last_not_of(" .\n") + 1);
}

Rescaling rescalingOf(vtkNIFTIImageHeader* header)
{
  const int type = header->GetDataType();
  const bool isColour =
    type == vtkNIFTIImageHeader::TypeRGB24 || type == vtkNIFTIImageHeader::TypeRGBA32;
  const double slope = header->GetSclSlope();
  return !isColour && std::isfinite(slope) && slope != 0.0
    ? Rescaling{ slope, header->GetSclInter() }
    : Rescaling();
}
}

NIFTIVolume::NIFTIVolume()
{
  this->Voxels->TimeAsVectorOn();
  this->KeepError->SetCallback(keepError);
  this->KeepError->SetClientData(&this->Error);
  for (vtkObject* speaker : { static_cast<vtkObject*>(this->Voxels),
         static_cast<vtkObject*>(this->Voxels->GetExecutive()) })
  {
    speaker->AddObserver(vtkCommand::ErrorEvent, this->KeepError);
    speaker->AddObserver(vtkCommand::WarningEvent, this->KeepError); // of flips, undone here
  }
}

std::string NIFTIVolume::readHeader(const std::string& fileName, VolumeHeader& header)
{
  std::string problem = niftiFileProblem(fileName);
  if (!problem.empty())
  {
    return problem;
  }
  this->Error.clear();
  this->Voxels->SetFileName(fileName.c_str());
  this->Voxels->Modified(); // the file may have changed under its name
  this->Voxels->UpdateInformation();
  if (!this->Error.empty())
  {
    return "cannot be read: " + this->Error;
  }
  vtkNIFTIImageHeader* stored = this->Voxels->GetNIFTIHeader();
  header.rescaling = rescalingOf(stored);
  if (!std::isfinite(header.rescaling.intercept))
  {
    return "has a scl_inter that is not finite";
  }
  header.times = timesOf(stored);
  this->Volumes = static_cast<int>(header.times.size());
  header.storedType = this->Voxels->GetDataScalarType();
  header.components = this->Voxels->GetNumberOfScalarComponents() / this->Volumes;
  header.worldFromVoxel = worldFromVoxel(placementOf(stored));
  const int* extent = this->Voxels->GetDataExtent();
  header.dimensions = glm::ivec3(extent[1] + 1, extent[3] + 1, extent[5] + 1);
  if (this->reversesSlices())
  {
    header.worldFromVoxel = header.worldFromVoxel * voxelFromReversedSlices(header.dimensions.z);
  }
  const char* note = stored->GetDescrip();
  const bool saysUnknown = note && std::string(note).find(UnknownSidesNote) != std::string::npos;
  header.knowsSides = !saysUnknown && (stored->GetSFormCode() > 0 || stored->GetQFormCode() > 0);
  header.labels = niftiLabels(fileName);
  return {};
}

bool NIFTIVolume::reversesSlices() const
{
  return this->Voxels->GetQFac() < 0.0;
}

double NIFTIVolume::storedBytes(const VolumeHeader& header) const
{
  const bool isLoaded = this->Voxels->GetOutput()->GetNumberOfPoints() > 0; // of a time series
  return isLoaded ? 0.0 : this->Volumes * VolumeFile::storedBytes(header);
}

std::string NIFTIVolume::load(std::size_t volume, const Progress&, StoredVoxels& voxels)
{
  this->Error.clear();
  this->Voxels->UpdateWholeExtent();
  if (!this->Error.empty())
  {
    return this->Error;
  }
  vtkImageData* read = this->Voxels->GetOutput();
  voxels.firstComponent =
    static_cast<int>(volume) * (read->GetNumberOfScalarComponents() / this->Volumes);
  voxels.image = vtkSmartPointer<vtkImageData>::New();
  voxels.image->ShallowCopy(read);
  if (this->Volumes == 1)
  {
    read->ReleaseData(); // a time series is kept: its next step comes from it
  }
  return {};
}

extern const VolumeFormat VolumesOfNIFTI{ "NIFTI", isNIFTIFile, makeVolumeFile<NIFTIVolume> };
}

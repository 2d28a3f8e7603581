// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Files/NIFTIVolume.h"

#include "Filters/Attached/HostMemory.h"
#include "Filters/Deformation/Parallel.h"
#include "Filters/Files/NIFTIFileCheck.h"

#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkExecutive.h"
#include "vtkImageData.h"
#include "vtkNIFTIImageHeader.h"

#include <array>
#include <cmath>
#include <sstream>

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

// Fills `shown`, whose extent may be a part of the whole, from the voxels as the file orders them.
template <typename StoredType, typename ShownType, typename Convert>
void moveVoxels(vtkImageData* stored, vtkImageData* shown, const NIFTIGrid& geometry,
  int firstComponent, const Convert& convert)
{
  const std::array<int, 3> dimensions{ geometry.grid.dimensions.x, geometry.grid.dimensions.y,
    geometry.grid.dimensions.z };
  vtkIdType increments[3];
  stored->GetIncrements(increments);
  std::array<vtkIdType, 3> step;
  const StoredType* first = static_cast<StoredType*>(stored->GetScalarPointer()) + firstComponent;
  for (int axis = 0; axis < 3; ++axis)
  {
    const vtkIdType forward = increments[geometry.voxelAxis[axis]];
    step[axis] = geometry.reversed[axis] ? -forward : forward;
    first += geometry.reversed[axis] ? forward * (dimensions[axis] - 1) : 0;
  }
  int extent[6];
  shown->GetExtent(extent);
  const int components = shown->GetNumberOfScalarComponents();
  parallelFor(extent[4], extent[5] + 1, 1, [&](vtkIdType zBegin, vtkIdType zEnd) {
    for (int z = static_cast<int>(zBegin); z < zEnd; ++z)
    {
      for (int y = extent[2]; y <= extent[3]; ++y)
      {
        auto* to = static_cast<ShownType*>(shown->GetScalarPointer(extent[0], y, z));
        const StoredType* from = first + extent[0] * step[0] + y * step[1] + z * step[2];
        for (int x = extent[0]; x <= extent[1]; ++x, from += step[0])
        {
          for (int component = 0; component < components; ++component)
          {
            *to++ = convert(from[component]);
          }
        }
      }
    }
  });
}

template <typename T, typename Rescaling>
void moveVoxelsOf(vtkImageData* stored, vtkImageData* shown, const NIFTIGrid& geometry,
  int firstComponent, const Rescaling& rescaling)
{
  if (!rescaling.needed)
  {
    moveVoxels<T, T>(stored, shown, geometry, firstComponent, [](T value) { return value; });
    return;
  }
  moveVoxels<T, float>(stored, shown, geometry, firstComponent, [&rescaling](T value) {
    return static_cast<float>(rescaling.slope * static_cast<double>(value) + rescaling.intercept);
  });
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

NIFTIVolume::Rescaling NIFTIVolume::rescalingOf(vtkNIFTIImageHeader* header)
{
  const int type = header->GetDataType();
  const bool isColour =
    type == vtkNIFTIImageHeader::TypeRGB24 || type == vtkNIFTIImageHeader::TypeRGBA32;
  Rescaling rescaling;
  const double slope = header->GetSclSlope();
  if (!isColour && std::isfinite(slope) && slope != 0.0)
  {
    rescaling.slope = slope;
    rescaling.intercept = header->GetSclInter();
    rescaling.needed = slope != 1.0 || rescaling.intercept != 0.0;
  }
  return rescaling;
}

std::string NIFTIVolume::readHeader(const std::string& fileName)
{
  this->Placed = false;
  this->FileName = fileName;
  if (fileName.empty())
  {
    return "FileName is empty; it must name a NIfTI file";
  }
  const std::string prefix = "NIfTI file " + fileName + " ";
  std::string problem = niftiFileProblem(fileName);
  if (!problem.empty())
  {
    return prefix + problem;
  }
  this->Error.clear();
  this->Voxels->SetFileName(fileName.c_str());
  this->Voxels->Modified(); // the file may have changed under its name
  this->Voxels->UpdateInformation();
  if (!this->Error.empty())
  {
    return prefix + "cannot be read: " + this->Error;
  }
  vtkNIFTIImageHeader* header = this->Voxels->GetNIFTIHeader();
  this->Rescale = rescalingOf(header);
  if (!std::isfinite(this->Rescale.intercept))
  {
    return prefix + "has a scl_inter that is not finite";
  }
  this->Times = timesOf(header);
  glm::dmat4 worldOfVoxel = worldFromVoxel(placementOf(header));
  problem = affineProblem(worldOfVoxel);
  if (!problem.empty())
  {
    return prefix + "cannot be placed: " + problem;
  }
  const int* extent = this->Voxels->GetDataExtent();
  const glm::ivec3 dimensions(extent[1] + 1, extent[3] + 1, extent[5] + 1);
  if (this->Voxels->GetQFac() < 0.0)
  {
    worldOfVoxel = worldOfVoxel * voxelFromReversedSlices(dimensions.z);
  }
  this->Geometry = nearestRasGrid(worldOfVoxel, dimensions);
  this->KnowsSides = header->GetSFormCode() > 0 || header->GetQFormCode() > 0;
  this->Placed = true;
  return {};
}

std::string NIFTIVolume::shearWarning() const
{
  if (!(this->Geometry.shear > LargestUnreportedShear))
  {
    return {};
  }
  std::ostringstream warning;
  warning << "NIfTI file " << this->FileName
          << " is sheared: the cosine between two of its axes is " << this->Geometry.shear
          << "; the limit is " << LargestUnreportedShear << ". Its corners are shown up to "
          << this->Geometry.largestErrorMm << " mm from where it places them";
  return warning.str();
}

int NIFTIVolume::components() const
{
  return this->Voxels->GetNumberOfScalarComponents() / static_cast<int>(this->Times.size());
}

int NIFTIVolume::scalarType() const
{
  return this->Rescale.needed ? VTK_FLOAT : this->Voxels->GetDataScalarType();
}

std::string NIFTIVolume::memoryProblem(const int extent[6]) const
{
  const glm::ivec3& size = this->Geometry.grid.dimensions;
  const bool isLoaded = this->Voxels->GetOutput()->GetNumberOfPoints() > 0; // of a time series
  const double stored = isLoaded ? 0.0
                                 : static_cast<double>(this->Geometry.grid.count()) *
      this->Voxels->GetNumberOfScalarComponents() *
      vtkDataArray::GetDataTypeSize(this->Voxels->GetDataScalarType());
  double shown =
    static_cast<double>(this->components()) * vtkDataArray::GetDataTypeSize(this->scalarType());
  for (int axis = 0; axis < 3; ++axis)
  {
    shown *= extent[2 * axis + 1] - extent[2 * axis] + 1.0;
  }
  return hostMemoryProblem(
    std::to_string(this->Times.size()) + " volumes of " + sizeText(glm::dvec3(size)) + " voxels",
    stored + shown);
}

std::string NIFTIVolume::load(vtkImageData* image, const int extent[6])
{
  std::string problem = this->memoryProblem(extent);
  if (problem.empty())
  {
    this->Error.clear();
    this->Voxels->UpdateWholeExtent();
    problem = this->Error;
  }
  if (problem.empty())
  {
    image->SetExtent(extent[0], extent[1], extent[2], extent[3], extent[4], extent[5]);
    image->AllocateScalars(this->scalarType(), this->components());
  }
  return problem.empty() ? problem : "NIfTI file " + this->FileName + " cannot be read: " + problem;
}

void NIFTIVolume::fill(vtkImageData* image, std::size_t volume)
{
  vtkImageData* stored = this->Voxels->GetOutput();
  const int firstComponent = static_cast<int>(volume) * this->components();
  switch (stored->GetScalarType())
  {
    vtkTemplateMacro(
      moveVoxelsOf<VTK_TT>(stored, image, this->Geometry, firstComponent, this->Rescale));
  }
  if (this->Times.size() == 1)
  {
    stored->ReleaseData(); // a time series is kept: its next step comes from it
  }
}
}

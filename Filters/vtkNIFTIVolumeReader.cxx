// SPDX-License-Identifier: BSD-3-Clause
#include "vtkNIFTIVolumeReader.h"

#include "Filters/Files/NIFTIFileCheck.h"
#include "Filters/Files/NIFTIGeometry.h"
#include "Filters/Deformation/Parallel.h"

#include "vtkCallbackCommand.h"
#include "vtkDataArray.h"
#include "vtkExecutive.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNIFTIImageHeader.h"
#include "vtkNIFTIImageReader.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <array>
#include <cmath>
#include <new>
#include <vector>

namespace
{
constexpr const char* ScalarsName = "Intensity";

// value = slope * stored + intercept
struct Rescaling
{
  bool needed = false;
  double slope = 1.0;
  double intercept = 0.0;
};

Rescaling rescalingOf(vtkNIFTIImageHeader* header)
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

brainshift::NIFTIPlacement placementOf(vtkNIFTIImageHeader* header)
{
  brainshift::NIFTIPlacement placement;
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
  placement.mmPerUnit = brainshift::mmPerNIFTIUnit(header->GetXYZTUnits());
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
  const double seconds = brainshift::secondsPerNIFTIUnit(header->GetXYZTUnits());
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

std::size_t nearestIndex(const std::vector<double>& times, double time)
{
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < times.size(); ++i)
  {
    if (std::abs(times[i] - time) < std::abs(times[nearest] - time))
    {
      nearest = i;
    }
  }
  return nearest;
}

// Fills `shown`, whose extent may be a part of the whole, from the voxels as the file orders them.
template <typename StoredType, typename ShownType, typename Convert>
void moveVoxels(vtkImageData* stored, vtkImageData* shown, const brainshift::NIFTIGrid& geometry,
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
  brainshift::parallelFor(extent[4], extent[5] + 1, 1, [&](vtkIdType zBegin, vtkIdType zEnd) {
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

template <typename T>
void moveVoxelsOf(vtkImageData* stored, vtkImageData* shown, const brainshift::NIFTIGrid& geometry,
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
  kept.erase(kept.find_last_not_of(" \n") + 1);
}
}

// What the file holds, in the file's order, and where it goes.
class vtkNIFTIVolumeReader::StoredVolume
{
public:
  StoredVolume()
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

  bool Placed = false; // whether Voxels, Geometry, Rescale and Times are of one good file
  std::string Error;   // of Voxels
  vtkNew<vtkCallbackCommand> KeepError;
  vtkNew<vtkNIFTIImageReader> Voxels; // all volumes of a time series as components
  brainshift::NIFTIGrid Geometry;
  Rescaling Rescale;
  std::vector<double> Times; // seconds, at least one

  int Components() const
  {
    return this->Voxels->GetNumberOfScalarComponents() / static_cast<int>(this->Times.size());
  }
  int ScalarType() const
  {
    return this->Rescale.needed ? VTK_FLOAT : this->Voxels->GetDataScalarType();
  }
};

vtkStandardNewMacro(vtkNIFTIVolumeReader);

vtkNIFTIVolumeReader::vtkNIFTIVolumeReader()
  : Stored(std::make_unique<StoredVolume>())
{
  this->SetNumberOfInputPorts(0);
}

vtkNIFTIVolumeReader::~vtkNIFTIVolumeReader()
{
  this->SetFileName(nullptr);
}

void vtkNIFTIVolumeReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
}

int vtkNIFTIVolumeReader::CanReadFile(const char* fileName)
{
  return fileName && brainshift::isNIFTIFile(fileName) ? 1 : 0;
}

std::string vtkNIFTIVolumeReader::ReadHeader()
{
  this->Stored->Placed = false;
  if (!this->FileName || !*this->FileName)
  {
    return "FileName is empty; it has to name a NIfTI file";
  }
  const std::string prefix = "NIfTI file " + std::string(this->FileName) + " ";
  std::string problem = brainshift::niftiFileProblem(this->FileName);
  if (!problem.empty())
  {
    return prefix + problem;
  }
  vtkNIFTIImageReader* voxels = this->Stored->Voxels;
  this->Stored->Error.clear();
  voxels->SetFileName(this->FileName);
  voxels->Modified(); // the file may have changed under its name
  voxels->UpdateInformation();
  if (!this->Stored->Error.empty())
  {
    return prefix + "cannot be read: " + this->Stored->Error;
  }
  vtkNIFTIImageHeader* header = voxels->GetNIFTIHeader();
  this->Stored->Rescale = rescalingOf(header);
  if (!std::isfinite(this->Stored->Rescale.intercept))
  {
    return prefix + "has a scl_inter that is not finite";
  }
  this->Stored->Times = timesOf(header);
  glm::dmat4 worldFromVoxel = brainshift::worldFromVoxel(placementOf(header));
  problem = brainshift::affineProblem(worldFromVoxel);
  if (!problem.empty())
  {
    return prefix + "cannot be placed: " + problem;
  }
  const int* extent = voxels->GetDataExtent();
  const glm::ivec3 dimensions(extent[1] + 1, extent[3] + 1, extent[5] + 1);
  if (voxels->GetQFac() < 0.0)
  {
    worldFromVoxel = worldFromVoxel * voxelFromReversedSlices(dimensions.z);
  }
  this->Stored->Geometry = brainshift::nearestRasGrid(worldFromVoxel, dimensions);
  this->Stored->Placed = true;
  return {};
}

void vtkNIFTIVolumeReader::ReportShear()
{
  const brainshift::NIFTIGrid& geometry = this->Stored->Geometry;
  if (geometry.shear > brainshift::LargestUnreportedShear)
  {
    vtkWarningMacro(<< "NIfTI file " << this->FileName << " is sheared: the cosine between two of "
                    << "its axes is " << geometry.shear << ", the limit "
                    << brainshift::LargestUnreportedShear << ". Its corners are shown up to "
                    << geometry.largestErrorMm << " mm from where it places them.");
  }
}

int vtkNIFTIVolumeReader::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  const std::string problem = this->ReadHeader();
  if (!problem.empty())
  {
    vtkErrorMacro(<< problem);
    return 0;
  }
  this->ReportShear();

  vtkInformation* output = outputs->GetInformationObject(0);
  const brainshift::Grid& grid = this->Stored->Geometry.grid;
  const int extent[6] = { 0, grid.dimensions.x - 1, 0, grid.dimensions.y - 1, 0,
    grid.dimensions.z - 1 };
  double directionRows[9];
  for (int i = 0; i < 9; ++i)
  {
    directionRows[i] = grid.direction[i % 3][i / 3];
  }
  output->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
  output->Set(vtkDataObject::SPACING(), &grid.spacing.x, 3);
  output->Set(vtkDataObject::ORIGIN(), &grid.origin.x, 3);
  output->Set(vtkDataObject::DIRECTION(), directionRows, 9);
  output->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1);
  vtkDataObject::SetPointDataActiveScalarInfo(
    output, this->Stored->ScalarType(), this->Stored->Components());

  const std::vector<double>& times = this->Stored->Times;
  output->Remove(vtkStreamingDemandDrivenPipeline::TIME_STEPS());
  output->Remove(vtkStreamingDemandDrivenPipeline::TIME_RANGE());
  if (times.size() > 1)
  {
    const double range[2] = { times.front(), times.back() };
    output->Set(
      vtkStreamingDemandDrivenPipeline::TIME_STEPS(), times.data(), static_cast<int>(times.size()));
    output->Set(vtkStreamingDemandDrivenPipeline::TIME_RANGE(), range, 2);
  }
  return 1;
}

bool vtkNIFTIVolumeReader::LoadVoxels(vtkInformation* information, vtkImageData* shown)
{
  std::string problem;
  try
  {
    this->Stored->Error.clear();
    this->Stored->Voxels->UpdateWholeExtent();
    problem = this->Stored->Error;
    if (problem.empty())
    {
      this->AllocateOutputData(
        shown, information, information->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT()));
    }
  }
  catch (const std::bad_alloc&)
  {
    const glm::ivec3& size = this->Stored->Geometry.grid.dimensions;
    problem = std::to_string(this->Stored->Times.size()) + " volumes of " + std::to_string(size.x) +
      " x " + std::to_string(size.y) + " x " + std::to_string(size.z) +
      " voxels do not fit in memory";
  }
  if (!problem.empty())
  {
    vtkErrorMacro(<< "NIfTI file " << this->FileName << " cannot be read: " << problem);
  }
  return problem.empty();
}

int vtkNIFTIVolumeReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkInformation* information = outputs->GetInformationObject(0);
  vtkImageData* shown = vtkImageData::GetData(information);
  // ParaView asks for data even after RequestInformation failed; that has been reported.
  if (!this->Stored->Placed || !this->LoadVoxels(information, shown))
  {
    return 0;
  }
  const std::vector<double>& times = this->Stored->Times;
  std::size_t volume = 0;
  if (times.size() > 1 && information->Has(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP()))
  {
    volume =
      nearestIndex(times, information->Get(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP()));
    shown->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), times[volume]);
  }
  shown->GetPointData()->GetScalars()->SetName(ScalarsName);
  vtkImageData* stored = this->Stored->Voxels->GetOutput();
  const int firstComponent = static_cast<int>(volume) * this->Stored->Components();
  switch (stored->GetScalarType())
  {
    vtkTemplateMacro(moveVoxelsOf<VTK_TT>(
      stored, shown, this->Stored->Geometry, firstComponent, this->Stored->Rescale));
  }
  if (times.size() == 1)
  {
    stored->ReleaseData(); // a time series is kept: its next step comes from it
  }
  return 1;
}

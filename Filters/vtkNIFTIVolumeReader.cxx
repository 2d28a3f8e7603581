// SPDX-License-Identifier: BSD-3-Clause
#include "vtkNIFTIVolumeReader.h"

#include "Filters/Attached/Guard.h"
#include "Filters/Attached/WorldAxes.h"
#include "Filters/Files/FieldImage.h"
#include "Filters/Files/NIFTIFileCheck.h"
#include "Filters/Files/NIFTIVolume.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <cmath>
#include <vector>

namespace
{
constexpr const char* ScalarsName = "Intensity";

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
}

vtkStandardNewMacro(vtkNIFTIVolumeReader);
brainshiftGuardRequestsMacro(vtkNIFTIVolumeReader);

vtkNIFTIVolumeReader::vtkNIFTIVolumeReader()
  : Stored(std::make_unique<brainshift::NIFTIVolume>())
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

int vtkNIFTIVolumeReader::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  const std::string problem = this->Stored->readHeader(this->FileName ? this->FileName : "");
  if (!problem.empty())
  {
    vtkErrorMacro(<< problem << ".");
    return 0;
  }
  const std::string warning = this->Stored->shearWarning();
  if (!warning.empty())
  {
    vtkWarningMacro(<< warning << ".");
  }

  vtkInformation* output = outputs->GetInformationObject(0);
  brainshift::announce(output, this->Stored->geometry().grid);
  output->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1);
  vtkDataObject::SetPointDataActiveScalarInfo(
    output, this->Stored->scalarType(), this->Stored->components());

  const std::vector<double>& times = this->Stored->times();
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

int vtkNIFTIVolumeReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  // ParaView asks for data even after RequestInformation failed; that has been reported.
  if (!this->Stored->isPlaced())
  {
    return 0;
  }
  vtkInformation* information = outputs->GetInformationObject(0);
  vtkImageData* shown = vtkImageData::GetData(information);
  const std::string problem =
    this->Stored->load(shown, information->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT()));
  if (!problem.empty())
  {
    vtkErrorMacro(<< problem << ".");
    return 0;
  }
  const std::vector<double>& times = this->Stored->times();
  std::size_t volume = 0;
  if (times.size() > 1 && information->Has(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP()))
  {
    volume =
      nearestIndex(times, information->Get(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP()));
    shown->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), times[volume]);
  }
  shown->GetPointData()->GetScalars()->SetName(ScalarsName);
  this->Stored->fill(shown, volume);
  brainshift::nameWorldAxes(shown,
    this->Stored->knowsSides() ? brainshift::WorldAxes::RAS : brainshift::WorldAxes::Unknown);
  return 1;
}

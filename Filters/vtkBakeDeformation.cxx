// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBakeDeformation.h"

#include "Common/Guard.h"
#include "Common/HostMemory.h"
#include "Common/ImageGrid.h"
#include "Common/ImageParts.h"
#include "Common/LabelTable.h"
#include "Common/SharedArray.h"
#include "Common/WorldAxes.h"
#include "Filters/Attached/BakedVolume.h"
#include "Filters/Attached/DeformableVolume.h"

#include "vtkDemandDrivenPipeline.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationExecutivePortKey.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <optional>

using namespace brainshift;
using Pipeline = vtkStreamingDemandDrivenPipeline;

vtkStandardNewMacro(vtkBakeDeformation);
brainshiftGuardRequestsMacro(vtkBakeDeformation);

namespace
{
constexpr double BytesInMiB = 1048576.0;

// On ranks, what is asked for ends at a multiple of so many points: small strokes then need no
// others, and the reader need not read again.
constexpr int RankStep = 32;

Extent widened(const Extent& extent, const Extent& whole)
{
  Extent wide = extent;
  for (int axis = 0; axis < 3; ++axis)
  {
    const int start = whole[2 * axis];
    wide[2 * axis] = start + (extent[2 * axis] - start) / RankStep * RankStep;
    wide[2 * axis + 1] = std::min(
      start + ((extent[2 * axis + 1] - start) / RankStep + 1) * RankStep, whole[2 * axis + 1]);
  }
  return wide;
}

// What says that the voxels of an input are still the same: when the pipeline above was modified
// last, and which time is asked for. Free-Form Deformation and what ParaView puts behind each
// filter pass voxels on.
std::pair<vtkMTimeType, double> stampOf(vtkInformation* input)
{
  const double time =
    input->Has(Pipeline::UPDATE_TIME_STEP()) ? input->Get(Pipeline::UPDATE_TIME_STEP()) : 0.0;
  vtkExecutive* producer = nullptr;
  int port = 0;
  vtkExecutive::PRODUCER()->Get(input, producer, port);
  const auto passesOn = [](vtkExecutive* executive) {
    vtkAlgorithm* filter = executive->GetAlgorithm();
    return (filter->IsA("vtkFreeFormDeformation") || filter->IsA("vtkPVPostFilter")) &&
      filter->GetNumberOfInputConnections(0) == 1;
  };
  while (producer && passesOn(producer))
  {
    producer = producer->GetInputExecutive(0, 0);
  }
  auto* pipeline = vtkDemandDrivenPipeline::SafeDownCast(producer);
  return { pipeline ? pipeline->GetPipelineMTime() : 0, time };
}

// For the field, for what is made with it, and for the part of the input that is yet to come.
void requireMemory(vtkImageData* input, const Extent& asked, const Lattice& lattice, int samples)
{
  requireOffsetFieldMemory(lattice, samples);
  const double bytes = pointsIn(asked) * bytesOfPoint(input) + offsetFieldBytes(lattice, samples);
  const glm::dvec3 sides =
    glm::dvec3(asked[1], asked[3], asked[5]) - glm::dvec3(asked[0], asked[2], asked[4]) + 1.0;
  requireHostMemory("A bake of " + sizeText(sides) + " points", bytes);
}

// What the baked volume says of itself.
void describe(vtkImageData* input, vtkImageData* output)
{
  output->CopyStructure(input);
  nameWorldAxes(output, worldAxesOf(input));
  nameTemplate(output, templateOf(input));
  attachLabels(output, attachedLabels(input));
  for (const char* name : { "Unit", "SmallIsBright" }) // of the values, for writers
  {
    output->GetFieldData()->AddArray(input->GetFieldData()->GetAbstractArray(name));
  }
  markLabelMap(output, isLabelMap(input));
}

// What is asked for, and which parts of the input it needs.
struct Request
{
  WholeVolume volume;
  Extent asked{};
  bool isOfRank = false;
  double bytesOfPoint = 0.0;
  double limit = 0.0; // bytes

  // The voxels that a block needs.
  Extent restOf(const Lattice& lattice, const Extent& block) const
  {
    const Extent rest = BakedVolume::restOf(this->volume, lattice, block);
    return this->isOfRank ? widened(rest, this->volume.extent) : rest;
  }

  bool fits(const Extent& extent) const
  {
    return pointsIn(extent) * this->bytesOfPoint <= 0.5 * this->limit;
  }

  std::vector<Extent> blocks(const Lattice& lattice) const
  {
    if (this->isOfRank)
    {
      return { this->asked };
    }
    return cutToFit(
      this->asked, [&](const Extent& block) { return this->fits(this->restOf(lattice, block)); });
  }
};
}

// What the last run found out, for the next piece.
struct vtkBakeDeformation::State
{
  std::optional<Lattice> lattice;
  std::optional<LowestValues> lowest;      // of the whole input
  std::pair<vtkMTimeType, double> stamp{}; // of the voxels that have these
};

// One run.
struct vtkBakeDeformation::Work
{
  vtkInformation* information; // of the input
  vtkImageData* input;
  const Request& request;
  const Lattice& lattice;
  BakedVolume baked;
  std::vector<Extent> blocks{};
  std::optional<LowestValues> lowest{}; // of the whole input
  bool isWhole = false;                 // whether the input is
  bool isStopped = false;
};

vtkBakeDeformation::vtkBakeDeformation()
  : Internal(std::make_unique<State>())
{
}

vtkBakeDeformation::~vtkBakeDeformation() = default;

int vtkBakeDeformation::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  // Each process bakes its own part.
  outputs->GetInformationObject(0)->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1);
  return 1;
}

int vtkBakeDeformation::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkInformation* input = inputs[0]->GetInformationObject(0);
  vtkInformation* output = outputs->GetInformationObject(0);
  const WholeVolume volume{ wholeGridOf(input), wholeExtentOf(input) };
  const Request request{ volume, pieceAskedOf(output), isOnePieceOfSeveral(output),
    bytesOfPoint(input), this->MemoryLimit * BytesInMiB };
  if (pointsIn(request.asked) == 0.0 || holds(request.asked, volume.extent) ||
    isBestAskedWhole(input, this->MemoryLimit))
  {
    updateWholeExtent(input);
    return 1;
  }
  // The lattice comes with any part, and says which part is needed. That of the last piece is
  // mostly the same. Several blocks are asked for one after the other.
  const std::optional<Lattice>& lattice = this->Internal->lattice;
  const bool isOneBlock = lattice && request.blocks(*lattice).size() == 1;
  updateExtent(
    input, isOneBlock ? request.restOf(*lattice, request.asked) : cornerOf(request.asked));
  return 1;
}

int vtkBakeDeformation::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkInformation* information = inputs[0]->GetInformationObject(0);
  vtkInformation* asked = outputs->GetInformationObject(0);
  vtkImageData* input = vtkImageData::GetData(inputs[0]);
  vtkImageData* output = vtkImageData::GetData(outputs);
  const Deformation deformation = readDeformation(input);
  const Lattice lattice = effectiveLattice(deformation);
  const Extent whole = wholeExtentOf(information);
  const Request request{ { gridOf(input, whole.data()), whole }, updateExtentOf(asked),
    isOnePieceOfSeveral(asked), bytesOfPoint(input), this->MemoryLimit * BytesInMiB };
  requireMemory(input, request.asked, lattice, deformation.samples);
  const BackwardMap backward(lattice, deformation.samples, deformation.inverse);
  Work work{ information, input, request, lattice,
    BakedVolume(request.volume, lattice.grid, backward, request.asked) };
  this->Prepare(work);
  const Extent before = extentOf(input);
  for (std::size_t block = 0; block < work.blocks.size() && !work.isStopped; ++block)
  {
    this->BakeBlock(work, block);
  }
  if (work.isStopped)
  {
    output->Initialize();
    return 1;
  }
  if (!holds(extentOf(input), before)) // another consumer may have asked for it
  {
    bringPart(information, before);
  }
  describe(input, output);
  work.baked.giveTo(output);
  SharedArrays().share(output->GetPointData());
  return 1;
}

void vtkBakeDeformation::Prepare(Work& work)
{
  State& state = *this->Internal;
  work.isWhole = holds(extentOf(work.input), work.request.volume.extent);
  if (work.isWhole)
  {
    work.blocks = { work.request.asked };
    work.lowest.emplace().add(work.input);
    return;
  }
  work.blocks = work.request.blocks(work.lattice);
  state.lattice = work.lattice;
  if (state.stamp == stampOf(work.information))
  {
    work.lowest = state.lowest;
  }
}

// Brings the voxels that the block needs, as often as it finds that it needs others.
void vtkBakeDeformation::BakeBlock(Work& work, std::size_t number)
{
  const Extent& block = work.blocks[number];
  const double blocks = static_cast<double>(work.blocks.size());
  const auto proceed = [&](double fraction) {
    this->UpdateProgress((static_cast<double>(number) + fraction) / blocks);
    return !this->CheckAbort();
  };
  const auto reading =
    isLabelMap(work.input) ? Reading::Nearest : static_cast<Reading>(this->Interpolation);
  Extent needed = work.isWhole ? block : work.request.restOf(work.lattice, block);
  LackingBlock lacking;
  do
  {
    if (!holds(extentOf(work.input), needed))
    {
      bringPart(work.information, needed);
    }
    lacking =
      work.baked.bake(work.input, block, work.lowest ? &*work.lowest : nullptr, reading, proceed);
    work.isStopped = lacking.stopped;
    needed = lacking.extent ? *lacking.extent : needed;
    if (lacking.lowest && !work.isStopped)
    {
      this->FindLowest(work);
    }
  } while (!work.isStopped && (lacking.extent || lacking.lowest));
}

// Reads all of the input, part by part.
void vtkBakeDeformation::FindLowest(Work& work)
{
  const Extent& whole = work.request.volume.extent;
  LowestValues lowest;
  for (const Extent& part :
    cutToFit(whole, [&](const Extent& extent) { return work.request.fits(extent); }))
  {
    if (this->CheckAbort())
    {
      work.isStopped = true;
      return;
    }
    bringPart(work.information, withNextPoints(part, whole)); // with the cells between two parts
    lowest.add(work.input);
  }
  this->Internal->lowest = lowest;
  this->Internal->stamp = stampOf(work.information);
  work.lowest = std::move(lowest);
}

void vtkBakeDeformation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Interpolation: " << this->Interpolation << "\n"
     << indent << "MemoryLimit: " << this->MemoryLimit << "\n";
}

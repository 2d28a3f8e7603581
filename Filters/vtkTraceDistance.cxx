// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTraceDistance.h"

#include "Common/FilledArray.h"
#include "Common/Guard.h"
#include "Common/ImageGrid.h"
#include "Common/Numbers.h"
#include "Common/Portions.h"
#include "Common/RankAgreement.h"
#include "Common/RankInputs.h"
#include "Filters/Attached/DeformableVolume.h"
#include "Filters/Attached/InputAxes.h"
#include "Filters/Attached/MaskImage.h"
#include "Filters/Traces/DeformedSurface.h"
#include "Filters/Traces/StrokeMarks.h"
#include "Filters/Traces/TraceStatistics.h"

#include "vtkCompositeDataIterator.h"
#include "vtkDataObjectTree.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"

#include <cmath>
#include <cstring>
#include <numeric>

using namespace brainshift;

namespace
{
constexpr int DeformationPort = 1;
constexpr int SegmentationPort = 2;
constexpr int TraceCavityPort = 3;
constexpr vtkIdType TracesAtLeast = 32; // for a thread: about 0.1 ms
constexpr const char* NotRun = "The distances have not been measured";

// The numbers of all processes, on each of them.
std::vector<double> ofAllProcesses(const std::vector<double>& own)
{
  vtkMultiProcessController* processes = severalRanks();
  if (!processes)
  {
    return own;
  }
  const int count = processes->GetNumberOfProcesses();
  const auto length = static_cast<vtkIdType>(own.size());
  std::vector<vtkIdType> lengths(count);
  processes->AllGather(&length, lengths.data(), 1);
  std::vector<vtkIdType> offsets(count, 0);
  for (int i = 1; i < count; ++i)
  {
    offsets[i] = offsets[i - 1] + lengths[i - 1];
  }
  std::vector<double> all(offsets.back() + lengths.back());
  processes->AllGatherV(own.data(), all.data(), length, lengths.data(), offsets.data());
  return all;
}

template <typename ArrayType, typename Value>
void addField(vtkDataObject* data, const char* name, Value value)
{
  vtkNew<ArrayType> array;
  array->SetName(name);
  array->InsertNextValue(value);
  data->GetFieldData()->AddArray(array);
}
}

struct vtkTraceDistance::State
{
  // The triangle that was nearest to a point (below 0: none) as the surface lay.
  struct Found
  {
    glm::dvec3 point{ 0.0 };
    int triangle = -1;
    int surfaceState = 0;
  };

  std::string Warned;
  TissueSource Tissue;
  DeformedSurface Surface; // of the tissue
  CavitySource CavityInput;
  PlacedVoxels Cavity;           // that of the input
  PlacedVoxels ReferencesCavity; // that Compare Volumes attached to the volume
  std::optional<PointMap> Map;
  // Of the points of all blocks, what was nearest.
  std::vector<Found> Nearest;
  TraceStatistics Statistics;
  TraceHistogram Histogram;
  vtkNew<vtkDoubleArray> HistogramNumbers; // as a server sends them
  StrokeCurve Curve;                       // RMS, mm
  vtkNew<vtkDoubleArray> CurveNumbers;
  int SurfacesFound = 0;
  std::string Problem = NotRun;

  // Leaves no figure of the last run. The curve remembers what it noted.
  void forget(const std::string& problem)
  {
    this->Problem = problem;
    this->Statistics = {};
    this->Histogram = {};
    this->Curve.note({}, 0, this->Statistics.rms);
  }

  bool isRemoved(const glm::dvec3& deformed) const
  {
    return brainshift::isRemoved(this->Cavity, deformed) ||
      brainshift::isRemoved(this->ReferencesCavity, deformed);
  }

  // mm; infinite if there is no surface. `hint`: a triangle, where nothing was found before.
  double distanceTo(const glm::dvec3& point, int hint, Found& found) const
  {
    const int now = this->Surface.state();
    const bool same = found.triangle >= 0 && found.point == point;
    const TriangleTree::Nearest nearest = same && found.surfaceState == now - 1
      ? this->Surface.nearestAfterMove(point, found.triangle)
      : this->Surface.nearest(point, found.triangle < 0 ? hint : found.triangle);
    found = { point, nearest.triangle, now };
    return nearest.distance;
  }

  // Points from the number `first` on, counted from there, so that neighbours follow each other:
  // they ask for the same part of the surface, which then is in the processor's caches.
  std::vector<vtkIdType> byTriangle(std::size_t first, vtkIdType count) const
  {
    std::vector<vtkIdType> order(count);
    std::iota(order.begin(), order.end(), vtkIdType(0));
    std::stable_sort(order.begin(), order.end(), [&](vtkIdType left, vtkIdType right) {
      return this->Nearest[first + left].triangle < this->Nearest[first + right].triangle;
    });
    return order;
  }
};

vtkStandardNewMacro(vtkTraceDistance);
brainshiftGuardRequestsMacro(vtkTraceDistance);
brainshiftInputsOfAllRanksMacro(vtkTraceDistance);

vtkTraceDistance::vtkTraceDistance()
  : Internal(std::make_unique<State>())
{
  this->SetNumberOfInputPorts(4);
}

vtkTraceDistance::~vtkTraceDistance() = default;

void vtkTraceDistance::SetDeformationConnection(vtkAlgorithmOutput* volume)
{
  this->SetInputConnection(DeformationPort, volume);
}

void vtkTraceDistance::SetSegmentationConnection(vtkAlgorithmOutput* segmentation)
{
  this->SetInputConnection(SegmentationPort, segmentation);
}

void vtkTraceDistance::SetCavityConnection(vtkAlgorithmOutput* mask)
{
  this->SetInputConnection(TraceCavityPort, mask);
}

void vtkTraceDistance::AddCavityLabel(int label)
{
  this->CavityLabels.push_back(label);
  this->Modified();
}

void vtkTraceDistance::ClearCavityLabels()
{
  this->CavityLabels.clear();
  this->Modified();
}

int vtkTraceDistance::GetCount() const
{
  return static_cast<int>(this->Internal->Statistics.count);
}

double vtkTraceDistance::GetMean() const
{
  return this->Internal->Statistics.mean;
}

double vtkTraceDistance::GetRMS() const
{
  return this->Internal->Statistics.rms;
}

double vtkTraceDistance::GetPercentile95() const
{
  return this->Internal->Statistics.percentile95;
}

vtkDoubleArray* vtkTraceDistance::GetHistogram()
{
  const TraceHistogram& histogram = this->Internal->Histogram;
  std::vector<double> numbers{ histogram.width };
  numbers.insert(numbers.end(), histogram.counts.begin(), histogram.counts.end());
  return filled(this->Internal->HistogramNumbers, numbers);
}

vtkDoubleArray* vtkTraceDistance::GetRMSAfterStrokes()
{
  return filled(this->Internal->CurveNumbers, this->Internal->Curve.values());
}

const char* vtkTraceDistance::GetProblem() const
{
  return this->Internal->Problem.c_str();
}

int vtkTraceDistance::GetSurfacesFound() const
{
  return this->Internal->SurfacesFound;
}

vtkIdType vtkTraceDistance::GetPointsMoved() const
{
  return this->Internal->Surface.mapped();
}

int vtkTraceDistance::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 0)
  {
    // Blocks first: then the pipeline leaves them together, and numbers are those of all blocks.
    info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObjectTree");
    info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPointSet");
    return 1;
  }
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), port != DeformationPort);
  return 1;
}

int vtkTraceDistance::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  // If something upstream fails, RequestData is never called; if memory runs out, this stays.
  this->Internal->forget(NotRun);
  // Any point may be nearest to any part of the cortex.
  for (int port = DeformationPort; port <= TraceCavityPort; ++port)
  {
    updateWholeExtent(inputs[port]->GetInformationObject(0));
  }
  return this->Superclass::RequestUpdateExtent(request, inputs, outputs);
}

void vtkTraceDistance::FindCortex(vtkInformationVector** inputs)
{
  State& state = *this->Internal;
  vtkImageData* volume = vtkImageData::GetData(inputs[DeformationPort]);
  vtkImageData* segmentation = vtkImageData::GetData(inputs[SegmentationPort]);
  const Deformation deformation = readDeformation(volume);
  vtkImageData* image = segmentation ? segmentation : volume;
  const int port = segmentation ? SegmentationPort : DeformationPort;
  requireWhole(image, inputs[port]->GetInformationObject(0));
  const std::string where = segmentation ? "The segmentation" : "The volume";
  vtkDataArray* scalars = scalarsOf(image, this->SurfaceArray);
  if (!scalars || scalars->GetNumberOfComponents() != 1)
  {
    throw Problem(where +
      (scalars ? "'s array " + std::string(scalars->GetName() ? scalars->GetName() : "") + " has " +
            std::to_string(scalars->GetNumberOfComponents()) + " components; it must have 1"
               : std::string(" has no point array to find the cortex in")));
  }
  const bool byLabel = this->SurfaceBy == ByLabel;
  const double level = byLabel ? this->Label : this->Threshold;
  if (state.Tissue.find(scalars, gridOf(image), byLabel, level) || state.Surface.isEmpty())
  {
    state.Surface = DeformedSurface(surfaceOf(state.Tissue.region()));
    state.Nearest.clear();
    ++state.SurfacesFound;
  }
  if (state.Surface.isEmpty())
  {
    const double* range = scalars->GetRange(0);
    throw Problem((byLabel ? "Label is " + std::to_string(this->Label)
                           : "Threshold is " + numberText(this->Threshold)) +
      " and gives no surface; the scalars of " +
      (segmentation ? "the segmentation" : "the volume") + " go from " + roundedText(range[0]) +
      " to " + roundedText(range[1]));
  }
  const Lattice lattice = effectiveLattice(deformation);
  state.Map.emplace(lattice, deformation.inverse);
  state.Cavity = {};
  state.Cavity = state.CavityInput.find(vtkImageData::GetData(inputs[TraceCavityPort]),
    this->CavityLabels, gridOf(volume), { "cavity", "volume", "CavityLabels" });
  state.ReferencesCavity = readReference(volume).cavity;
  std::function<bool(const glm::dvec3&)> isRemoved;
  if (state.Cavity.voxels || state.ReferencesCavity.voxels)
  {
    isRemoved = [&](const glm::dvec3& deformed) { return state.isRemoved(deformed); };
  }
  state.Surface.follow(lattice, isRemoved);
}

bool vtkTraceDistance::Measure(vtkPointSet* points, std::vector<double>& all)
{
  State& state = *this->Internal;
  const vtkIdType count = points->GetNumberOfPoints();
  vtkNew<vtkFloatArray> distances;
  distances->SetName("DistanceToCortex");
  distances->SetNumberOfTuples(count);
  points->GetPointData()->AddArray(distances);
  points->GetPointData()->SetActiveScalars(distances->GetName());
  const std::size_t before = all.size();
  all.resize(before + count, std::numeric_limits<double>::quiet_NaN());
  state.Nearest.resize(std::max(state.Nearest.size(), all.size()));
  const auto distanceOf = [&](const glm::dvec3& point, int hint, State::Found& found) {
    if (!std::isfinite(point.x + point.y + point.z) || state.isRemoved(point))
    {
      return std::numeric_limits<double>::quiet_NaN();
    }
    const double distance = state.distanceTo(point, hint, found);
    const bool inside = state.Tissue.region().contains(state.Map->restFromDeformed(point));
    return std::isfinite(distance) ? (inside ? -distance : distance)
                                   : std::numeric_limits<double>::quiet_NaN();
  };
  const std::vector<vtkIdType> order = state.byTriangle(before, count);
  return forPortions({ this }, count, TracesAtLeast, [&](vtkIdType first, vtkIdType last) {
    int previous = -1; // the first time: a pointer moves little
    for (vtkIdType step = first; step < last; ++step)
    {
      const vtkIdType i = order[step];
      double point[3];
      points->GetPoints()->GetData()->GetTuple(i, point);
      State::Found& found = state.Nearest[before + i];
      const double distance = distanceOf({ point[0], point[1], point[2] }, previous, found);
      previous = found.triangle;
      all[before + i] = distance;
      distances->SetValue(i, static_cast<float>(distance));
    }
  });
}

bool vtkTraceDistance::MeasureAll(
  vtkDataObject* input, vtkDataObject* output, std::vector<double>& distances)
{
  auto* blocks = vtkDataObjectTree::SafeDownCast(input);
  if (!blocks)
  {
    output->ShallowCopy(input);
    return this->Measure(vtkPointSet::SafeDownCast(output), distances);
  }
  bool going = true;
  auto* measured = vtkDataObjectTree::SafeDownCast(output);
  measured->CompositeShallowCopy(blocks);
  const auto block = vtkSmartPointer<vtkCompositeDataIterator>::Take(blocks->NewIterator());
  for (block->InitTraversal(); going && !block->IsDoneWithTraversal(); block->GoToNextItem())
  {
    if (auto* points = vtkPointSet::SafeDownCast(block->GetCurrentDataObject()))
    {
      auto copy = vtkSmartPointer<vtkPointSet>::Take(points->NewInstance());
      copy->ShallowCopy(points);
      measured->SetDataSet(block, copy);
      going = this->Measure(copy, distances);
    }
  }
  return going;
}

void vtkTraceDistance::NoteRMS(vtkDataObject* points, vtkDataObject* volume)
{
  State& state = *this->Internal;
  const auto timeOf = [](vtkDataArray* array) { return array ? array->GetMTime() : 0; };
  const double used = this->SurfaceBy == ByLabel ? this->Label : this->Threshold;
  std::uint64_t level = 0; // its bits
  std::memcpy(&level, &used, sizeof(level));
  std::uint64_t how = mixed(mixed(points->GetMTime(), state.Tissue.time()), level);
  how = mixed(mixed(how, this->SurfaceBy), timeOf(state.Cavity.voxels));
  how = mixed(how, timeOf(state.ReferencesCavity.voxels));
  state.Curve.note(readMarks(volume), how, state.Statistics.rms);
}

int vtkTraceDistance::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  State& state = *this->Internal;
  vtkDataObject* input = vtkDataObject::GetData(inputs[0]);
  vtkDataObject* output = vtkDataObject::GetData(outputs);
  warnAnew(this,
    wordsOnSidesOf(namedAxesOfInput("the traced points", this, 0),
      vtkDataObject::GetData(inputs[DeformationPort])),
    state.Warned);
  std::vector<double> distances;
  bool going = true;
  const std::string problem = problemOf([&] {
    runOnAllRanks("Trace Distance", [&] {
      this->FindCortex(inputs);
      going = this->MeasureAll(input, output, distances);
    });
  });
  if (!problem.empty())
  {
    state.forget(problem);
    throw Problem(problem);
  }
  const std::vector<double> all = ofAllProcesses(distances);
  state.Statistics = statisticsOf(all);
  state.Histogram = histogramOf(all);
  if (going)
  {
    state.Problem.clear();
    this->NoteRMS(input, vtkDataObject::GetData(inputs[DeformationPort]));
  }
  addField<vtkIntArray>(output, "Count", this->GetCount());
  addField<vtkDoubleArray>(output, "Mean", state.Statistics.mean);
  addField<vtkDoubleArray>(output, "RMS", state.Statistics.rms);
  addField<vtkDoubleArray>(output, "Percentile95", state.Statistics.percentile95);
  if (!going)
  {
    state.forget(NotRun);
    output->Initialize();
  }
  return 1;
}

void vtkTraceDistance::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SurfaceArray: " << this->SurfaceArray << "\n"
     << indent << "SurfaceBy: " << (this->SurfaceBy == ByLabel ? "Label" : "Threshold") << "\n"
     << indent << "Threshold: " << this->Threshold << "\n"
     << indent << "Label: " << this->Label << "\n"
     << indent << "Count: " << this->GetCount() << "\n";
}

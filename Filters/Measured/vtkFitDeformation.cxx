// SPDX-License-Identifier: BSD-3-Clause
#include "vtkFitDeformation.h"

#include "Common/FilledArray.h"
#include "Common/Guard.h"
#include "Common/Numbers.h"
#include "Common/RankAgreement.h"
#include "Common/RankInputs.h"
#include "Common/WorldAxes.h"
#include "Filters/Attached/DeformableVolume.h"
#include "Filters/Attached/InputAxes.h"
#include "Filters/Attached/MaskImage.h"
#include "Filters/Fields/BaseLattice.h"
#include "Filters/Fit/PackedTables.h"
#include "Filters/Fit/PairDoubts.h"
#include "Filters/Measured/EvidenceArray.h"
#include "Filters/Measured/MeasuredPoints.h"
#include "Filters/Measured/RestCortex.h"
#include "Formats/Fields/FieldImage.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointSet.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <utility>

using namespace brainshift;

namespace
{
// After those of every lattice.
constexpr int RestPort = 3;
constexpr int MeasuredPort = 4;
constexpr int TracesPort = 5;
constexpr int SegmentationPort = 6;
constexpr int CavityPort = 7;
constexpr int OpeningPort = 8;
constexpr int Ports = 9;

constexpr std::size_t FewestPairs = 3; // fewer are no news to a hand that is picking them
constexpr double FarTraceMm = 25.0;    // half of the traces: more than brains shift
constexpr std::size_t MostTracesToDoubt = 500;
constexpr double FarRotationDegrees = 10.0; // more than this is rather a wrong pair
constexpr const char* NotRun = "The fit has not run";

bool isOfPoints(int port)
{
  return port >= RestPort && port <= TracesPort;
}

// Joins sentences by full stops; the last one has none.
std::string joinedSentences(const std::vector<std::string>& sentences)
{
  std::string text;
  for (const std::string& sentence : sentences)
  {
    text += (text.empty() || sentence.empty() ? "" : ". ") + sentence;
  }
  return text;
}

// What is suspicious about traced points that are far from the cortex at rest.
std::string doubtAboutTraces(const std::vector<glm::dvec3>& traces, const RestSurface& surface)
{
  std::vector<double> distances;
  const std::size_t step = 1 + traces.size() / MostTracesToDoubt;
  for (std::size_t i = 0; surface && i < traces.size(); i += step)
  {
    if (const std::optional<SurfacePoint> nearest = surface(traces[i], i))
    {
      distances.push_back(glm::distance(traces[i], nearest->position));
    }
  }
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return distances.empty() || *middle <= FarTraceMm
    ? std::string()
    : "The traced points are " + roundedText(*middle) +
      " mm (median) from the cortex at rest; check that they are in mm and in the volume's frame, "
      "and what counts as cortex";
}

// What a user must know about a fit that has a result.
std::string warningAbout(const FittedLattice& fitted)
{
  std::vector<std::string> sentences;
  const double degrees = glm::degrees(glm::length(vectorFrom(fitted.fit().rigid().rotation)));
  if (degrees > FarRotationDegrees && fitted.fit().isRotationExpectedSmall())
  {
    sentences.push_back("The fit rotated the volume by " + roundedText(degrees) +
      " degrees, more than so few pairs can support; check that the pairs match");
  }
  if (fitted.fraction() < 1.0)
  {
    sentences.push_back(
      "The fold guard applied " + percentText(fitted.fraction()) + " of the deformation");
  }
  else if (fitted.relaxation() > 1.0)
  {
    sentences.emplace_back("The fold guard increased the standard deviations of the measurements, "
                           "so that no tissue folds");
  }
  return joinedSentences(sentences);
}
}

struct vtkFitDeformation::State
{
  CortexSource Cortex;
  AnchorChoice Chosen;
  CavitySource CavityInput;
  Grid Volume;
  Lattice Still; // its control points, with the mask
  std::shared_ptr<const FitBase> Base;
  Measurements Measured;
  std::vector<std::size_t> TraceNumbers; // of the traces that count, in the input
  FittedLattice Fitted;
  LatticeEvidence Evidence;
  std::vector<double> LandmarkResiduals;
  std::vector<double> PullResiduals;
  std::vector<double> TraceResiduals; // of all traces of the input
  std::string Problem = NotRun;
  std::string Unmatched;
  std::string Repeated;
  std::vector<std::string> Names; // of the landmarks
  std::string Warning;
  std::string WarnedOf;

  // The figures as a server sends them.
  vtkNew<vtkDoubleArray> RigidNumbers;
  vtkNew<vtkDoubleArray> LandmarkResidualNumbers;
  vtkNew<vtkDoubleArray> PullResidualNumbers;
  vtkNew<vtkDoubleArray> TraceResidualNumbers;
  vtkNew<vtkDoubleArray> LeaveOneOutNumbers;

  // Leaves nothing of the last fit.
  void forget(const std::string& problem)
  {
    this->Problem = problem;
    this->Measured = {};
    this->Fitted = {};
    this->LandmarkResiduals.clear();
    this->PullResiduals.clear();
    this->TraceResiduals.clear();
    this->Unmatched.clear();
    this->Repeated.clear();
  }

  // What to know about how the measurements lie.
  std::string doubts()
  {
    const std::string places =
      joinedSentences(doubtsAbout(this->Measured, this->Names, this->Volume));
    const bool isSaid = places.find("traced points") != std::string::npos;
    const bool isOpen = !isSaid && !this->Measured.base; // which moves the cortex
    return joinedSentences(
      { places, isOpen ? doubtAboutTraces(this->Measured.traces, this->surface()) : "" });
  }

  // What to know besides.
  std::string warning() const
  {
    const bool isInCavity = !this->TraceResiduals.empty() && this->TraceNumbers.empty();
    return joinedSentences({ this->Unmatched.empty() ? "" : "Without a partner: " + this->Unmatched,
      this->Repeated.empty()
        ? ""
        : "Paired in the order of the lists, for the name occurs more than once: " + this->Repeated,
      isInCavity ? "All traced points are in the cavity and are ignored" : "",
      warningAbout(this->Fitted) });
  }

  // What a fit asks for the cortex. It must not outlive this object's next change.
  RestSurface surface()
  {
    if (this->Measured.traces.empty())
    {
      return {};
    }
    this->Hints.assign(this->Measured.traces.size(), -1);
    return [this](const glm::dvec3& rest, std::size_t trace) {
      return this->Cortex.cortex().nearest(rest, this->Hints[trace]);
    };
  }

private:
  std::vector<int> Hints; // a triangle for each trace
};

vtkStandardNewMacro(vtkFitDeformation);
brainshiftGuardRequestsMacro(vtkFitDeformation);
brainshiftInputsOfAllRanksMacro(vtkFitDeformation);

vtkFitDeformation::vtkFitDeformation()
  : Landmarks(std::make_unique<FitLandmarks>())
  , Internal(std::make_unique<State>())
{
  this->SetNumberOfInputPorts(Ports);
}

vtkFitDeformation::~vtkFitDeformation() = default;

void vtkFitDeformation::AddLandmarkPair(double number)
{
  this->Append(this->Landmarks->Numbers, number);
}

void vtkFitDeformation::ClearLandmarkPairs()
{
  this->Clear(this->Landmarks->Numbers);
}

void vtkFitDeformation::AddLandmarkOff(const char* name)
{
  this->Append(this->Landmarks->SwitchedOff, std::string(name ? name : ""));
}

void vtkFitDeformation::ClearLandmarksOff()
{
  this->Clear(this->Landmarks->SwitchedOff);
}

void vtkFitDeformation::SetPairByOrder(bool byOrder)
{
  if (this->Landmarks->Rule.byOrder != byOrder)
  {
    this->Landmarks->Rule.byOrder = byOrder;
    this->Modified();
  }
}

bool vtkFitDeformation::GetPairByOrder() const
{
  return this->Landmarks->Rule.byOrder;
}

void vtkFitDeformation::AddRestName(const char* name)
{
  this->Append(this->Landmarks->Rule.restNames, std::string(name ? name : ""));
}

void vtkFitDeformation::ClearRestNames()
{
  this->Clear(this->Landmarks->Rule.restNames);
}

void vtkFitDeformation::AddMeasuredName(const char* name)
{
  this->Append(this->Landmarks->Rule.measuredNames, std::string(name ? name : ""));
}

void vtkFitDeformation::ClearMeasuredNames()
{
  this->Clear(this->Landmarks->Rule.measuredNames);
}

int vtkFitDeformation::FillInputPortInformation(int port, vtkInformation* info)
{
  const int done = this->Superclass::FillInputPortInformation(port, info);
  if (isOfPoints(port))
  {
    info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPointSet");
  }
  return done;
}

int vtkFitDeformation::RequestInformation(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return this->AnnounceLattice(inputs, outputs);
}

int vtkFitDeformation::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  // If something upstream fails, RequestData is never called.
  this->Internal->Problem = NotRun;
  for (int port = 0; port < Ports; ++port)
  {
    if (isOfPoints(port))
    {
      askForOwnPoints(inputs[port]->GetInformationObject(0));
    }
    else
    {
      updateWholeExtent(inputs[port]->GetInformationObject(0));
    }
  }
  return 1;
}

void vtkFitDeformation::RequireProperties() const
{
  if (this->Pulls.size() % Packed<Pull>::Numbers || this->Pins.size() % Packed<Pin>::Numbers)
  {
    throw Problem("Pulls has " + std::to_string(this->Pulls.size()) + " numbers and Pins " +
      std::to_string(this->Pins.size()) + "; a pull has 7 and a pin 4");
  }
  if (this->Landmarks->Numbers.size() % Packed<PointPair>::Numbers)
  {
    throw Problem("LandmarkPairs has " + std::to_string(this->Landmarks->Numbers.size()) +
      " numbers; a pair has 7");
  }
  if (!(this->OpeningRadius >= 0.0 && std::isfinite(this->OpeningRadius)))
  {
    throw Problem("Opening Radius is " + numberText(this->OpeningRadius) +
      " mm; it must be 0 or more, and finite");
  }
}

std::string vtkFitDeformation::DoubtsAboutSides(vtkInformationVector** inputs)
{
  vtkDataObject* volume = vtkDataObject::GetData(inputs[0]);
  for (const auto& [port, noun] :
    { std::pair<int, const char*>{ BasePort, "the base" }, { RestPort, "the landmarks at rest" },
      { MeasuredPort, "the measured landmarks" }, { TracesPort, "the traced points" } })
  {
    NamedAxes given = namedAxesOfInput(noun, this, port);
    given.space = Template::None;
    if (vtkDataObject::GetData(inputs[port]) && given.axes == WorldAxes::Unknown &&
      isOfPoints(port))
    {
      given.axes = static_cast<WorldAxes>(this->PointAxes);
    }
    if (const std::string words = wordsOnSidesOf(given, volume); !words.empty())
    {
      return words; // the other inputs are as doubtful, and one sentence is enough
    }
  }
  return {};
}

void vtkFitDeformation::ReadMeasurements(vtkInformationVector** inputs)
{
  State& state = *this->Internal;
  state.Measured = {};
  PlacedVoxels cavity;
  runOnAllRanks("Fit Deformation", [&] {
    state.Volume = gridOf(vtkImageData::GetData(inputs[0]));
    requirePosition(state.Volume, "The volume's ");
    this->RequireProperties();
    cavity = state.CavityInput.find(vtkImageData::GetData(inputs[CavityPort]), this->CavityLabels,
      state.Volume, { "cavity", "volume", "CavityLabels" });
  });
  const auto points = [&](
                        int port) { return pointsOfAllRanks(vtkPointSet::GetData(inputs[port])); };
  const vtkSmartPointer<vtkPointSet> rest = points(RestPort);
  const vtkSmartPointer<vtkPointSet> measured = points(MeasuredPort);
  const std::vector<glm::dvec3> traces = positionsOf(points(TracesPort));
  NamedPairs named = this->Landmarks->read(rest, measured);
  state.Measured.landmarks = std::move(named.pairs);
  state.Unmatched = std::move(named.unmatched);
  state.Repeated = std::move(named.repeated);
  state.Names = std::move(named.names);
  state.Measured.pulls = rowsFrom<Pull>(this->Pulls);
  for (const Pin& pin : rowsFrom<Pin>(this->Pins))
  {
    if (pin.enabled)
    {
      state.Measured.pins.push_back(pin.rest);
    }
  }
  state.TraceResiduals.assign(traces.size(), NaN);
  state.TraceNumbers.clear();
  for (std::size_t i = 0; i < traces.size(); ++i)
  {
    if (!isRemoved(cavity, traces[i]))
    {
      state.TraceNumbers.push_back(i);
      state.Measured.traces.push_back(traces[i]);
    }
  }
  requireGood(state.Measured); // before anything is searched for at a position
}

void vtkFitDeformation::FindCortex(vtkInformationVector** inputs)
{
  vtkImageData* segmentation = vtkImageData::GetData(inputs[SegmentationPort]);
  vtkImageData* image = segmentation ? segmentation : vtkImageData::GetData(inputs[0]);
  const bool byLabel = this->SurfaceBy != 0;
  this->Internal->Cortex.find({ image, segmentation ? "segmentation" : "volume", this->SurfaceArray,
    !segmentation, byLabel, byLabel ? this->Label : this->Threshold });
}

void vtkFitDeformation::FindAnchors(vtkInformationVector** inputs)
{
  State& state = *this->Internal;
  Measurements& measured = state.Measured;
  vtkImageData* openingImage = vtkImageData::GetData(inputs[OpeningPort]);
  const bool isGiven = openingImage || this->OpeningRadius > 0.0;
  if (measured.traces.empty() && !(this->Anchors && isGiven && bendsOnly(measured)))
  {
    return;
  }
  this->FindCortex(inputs);
  if (!this->Anchors)
  {
    return;
  }
  if (openingImage)
  {
    const Mask opening = readMask(openingImage, {}, gridOf(vtkImageData::GetData(inputs[0])),
      { "opening", "volume", "labels" });
    const auto makeIsOpen = [&opening]() -> AnchorChoice::IsOpen {
      return [near = NearMask(opening, AnchorMarginMm)](
               const glm::dvec3& rest) { return near.holds(rest); };
    };
    measured.anchors = state.Chosen.beside(openingImage->GetMTime(), makeIsOpen, state.Cortex);
    return;
  }
  const OpeningBall given{
    { this->OpeningCentre[0], this->OpeningCentre[1], this->OpeningCentre[2] }, this->OpeningRadius
  };
  const OpeningBall ball = isGiven ? given : openingOf(measured);
  measured.anchors = state.Chosen.beside(ball, state.Cortex);
}

void vtkFitDeformation::FindBase(vtkInformationVector** inputs)
{
  State& state = *this->Internal;
  state.Still = this->MakeLattice(
    gridOf(vtkImageData::GetData(inputs[0])), vtkImageData::GetData(inputs[MaskPort]));
  vtkImageData* base = vtkImageData::GetData(inputs[BasePort]);
  if (!base || base->GetNumberOfPoints() == 0)
  {
    return;
  }
  Lattice bent = state.Still;
  addBase(bent, base);
  // A hand that drags leaves the base as it is, and with a mask its map takes long.
  if (!state.Base || !state.Base->isOf(bent))
  {
    state.Base = std::make_shared<const FitBase>(bent);
  }
  state.Measured.base = state.Base; // also one that moves nothing
}

void vtkFitDeformation::Solve(const Process* start)
{
  State& state = *this->Internal;
  const RestSurface surface = state.surface();
  state.Fitted.solve(
    state.Measured, surface, state.Still, { this->GetSamples(), this->GuardFolding, start });
  state.LandmarkResiduals = state.Fitted.residuals(state.Measured.landmarks);
  state.PullResiduals = state.Fitted.residuals(state.Measured.pulls);
  const std::vector<double> residuals = state.Fitted.traceResiduals(state.Measured.traces, surface);
  for (std::size_t i = 0; i < residuals.size(); ++i)
  {
    state.TraceResiduals[state.TraceNumbers[i]] = residuals[i];
  }
}

int vtkFitDeformation::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  State& state = *this->Internal;
  const FittedLattice before = std::move(state.Fitted);
  state.forget(NotRun); // if memory runs out, this stays
  try
  {
    this->ReadMeasurements(inputs);
    this->FindBase(inputs);
    this->FindAnchors(inputs);
    this->Solve(this->Live && before.isKnown() ? &before.fit().field() : nullptr);
    state.Problem.clear();
  }
  catch (const Problem& problem)
  {
    state.forget(problem.what());
    this->Landmarks->Names->Reset();
    throw;
  }
  vtkImageData* output = vtkImageData::GetData(outputs);
  const Lattice& bent = state.Fitted.lattice();
  setLattice(output, bent);
  attachFittedFor(output, bent, this->GetSamples());
  state.Evidence.setLive(this->Live);
  const std::string noEvidence = this->Evidence
    ? problemOf([&] { addEvidence(output, state.Fitted, state.Evidence); })
    : std::string();
  const std::string doubts = state.doubts();
  const std::size_t listed = this->Landmarks->Numbers.size() / Packed<PointPair>::Numbers;
  const bool isPicking =
    listed > 0 && listed < FewestPairs && listed == state.Measured.landmarks.size();
  const std::string warning = joinedSentences(
    { noEvidence, isPicking ? "" : doubts, this->DoubtsAboutSides(inputs), state.warning() });
  warnAnew(this, warning, state.WarnedOf); // it is repeated only after it was gone
  state.Warning = isPicking ? joinedSentences({ warning, doubts }) : warning;
  output->Crop(
    outputs->GetInformationObject(0)->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT()));
  return 1;
}

void vtkFitDeformation::AddCavityLabel(int label)
{
  this->CavityLabels.push_back(label);
  this->Modified();
}

void vtkFitDeformation::ClearCavityLabels()
{
  this->CavityLabels.clear();
  this->Modified();
}

double vtkFitDeformation::GetShare() const
{
  return this->Internal->Fitted.fraction();
}

double vtkFitDeformation::GetRelaxation() const
{
  return this->Internal->Fitted.relaxation();
}

double vtkFitDeformation::GetTraceRMS() const
{
  return rootMeanSquare(this->Internal->TraceResiduals);
}

double vtkFitDeformation::GetCalibration() const
{
  return this->Internal->Fitted.fit().calibration();
}

int vtkFitDeformation::GetSteps() const
{
  return this->Internal->Fitted.fit().steps();
}

int vtkFitDeformation::GetAnchorCount() const
{
  return static_cast<int>(this->Internal->Measured.anchors.size());
}

vtkDoubleArray* vtkFitDeformation::GetRigid()
{
  const RigidPose& rigid = this->Internal->Fitted.fit().rigid();
  std::vector<double> rows;
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      rows.push_back(rigid.rotation[column][row]);
    }
    rows.push_back(rigid.translation[row]);
  }
  rows.insert(rows.end(), { 0.0, 0.0, 0.0, 1.0 });
  return filled(this->Internal->RigidNumbers, rows);
}

vtkDoubleArray* vtkFitDeformation::GetLandmarkResiduals()
{
  return filled(this->Internal->LandmarkResidualNumbers, this->Internal->LandmarkResiduals);
}

vtkDoubleArray* vtkFitDeformation::GetPullResiduals()
{
  return filled(this->Internal->PullResidualNumbers, this->Internal->PullResiduals);
}

vtkDoubleArray* vtkFitDeformation::GetTraceResiduals()
{
  return filled(this->Internal->TraceResidualNumbers, this->Internal->TraceResiduals);
}

vtkDoubleArray* vtkFitDeformation::GetLeaveOneOut()
{
  return filled(this->Internal->LeaveOneOutNumbers,
    leaveOneOut(this->Internal->Fitted, this->Internal->Measured.landmarks));
}

vtkStringArray* vtkFitDeformation::GetLandmarkNames()
{
  return this->Landmarks->Names;
}

vtkDoubleArray* vtkFitDeformation::GetLandmarkPlaces()
{
  this->Landmarks->place(this->Internal->Fitted, this->Internal->Measured.landmarks);
  return this->Landmarks->Places;
}

const char* vtkFitDeformation::GetProblem() const
{
  return this->Internal->Problem.c_str();
}

const char* vtkFitDeformation::GetUnmatched() const
{
  return this->Internal->Unmatched.c_str();
}

std::string vtkFitDeformation::GetWarning() const
{
  return this->Internal->Problem.empty() ? this->Internal->Warning : std::string();
}

std::vector<double> vtkFitDeformation::MeasuredFromRest(const std::vector<double>& rest)
{
  std::vector<double> result;
  for (std::size_t i = 0; this->Internal->Fitted.isKnown() && i + 2 < rest.size(); i += 3)
  {
    const glm::dvec3 at =
      this->Internal->Fitted.measuredFromRest({ rest[i], rest[i + 1], rest[i + 2] });
    result.insert(result.end(), { at.x, at.y, at.z });
  }
  return result;
}

std::vector<double> vtkFitDeformation::Deviations(const std::vector<double>& rest)
{
  std::vector<glm::dvec3> positions;
  for (std::size_t i = 0; this->Internal->Fitted.isKnown() && i + 2 < rest.size(); i += 3)
  {
    positions.emplace_back(rest[i], rest[i + 1], rest[i + 2]);
  }
  return this->Internal->Fitted.deviations(positions);
}

std::vector<double> vtkFitDeformation::Rows() const
{
  std::vector<double> numbers;
  if (this->Internal->Fitted.isKnown())
  {
    for (const Row& row : this->Internal->Fitted.fit().field().rows())
    {
      numbers.insert(numbers.end(),
        { row.point.x, row.point.y, row.point.z, row.axis.x, row.axis.y, row.axis.z,
          row.variance });
    }
  }
  return numbers;
}

std::vector<double> vtkFitDeformation::Covariance() const
{
  if (!this->Internal->Fitted.isKnown())
  {
    return {};
  }
  const FitSettings settings;
  const Matern& kernel =
    bendsOnly(this->Internal->Measured) ? settings.surfaceKernel : settings.landmarkKernel;
  return { kernel.lengthMm, kernel.deviationMm };
}

void vtkFitDeformation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "GuardFolding: " << this->GuardFolding << "\n"
     << indent << "Live: " << this->Live << "\n"
     << indent << "SurfaceArray: " << this->SurfaceArray << "\n"
     << indent << "SurfaceBy: " << (this->SurfaceBy ? "Label" : "Threshold") << "\n"
     << indent << "Threshold: " << this->Threshold << "\n"
     << indent << "Label: " << this->Label << "\n"
     << indent << "Anchors: " << this->Anchors << "\n"
     << indent << "OpeningRadius: " << this->OpeningRadius << "\n"
     << indent << "PointAxes: " << this->PointAxes << "\n"
     << indent << "Evidence: " << this->Evidence << "\n"
     << indent << "LandmarkPairs: " << this->Landmarks->Numbers.size() / Packed<PointPair>::Numbers
     << "\n"
     << indent << "Pulls: " << this->Pulls.size() / Packed<Pull>::Numbers << "\n"
     << indent << "Pins: " << this->Pins.size() / Packed<Pin>::Numbers << "\n";
}

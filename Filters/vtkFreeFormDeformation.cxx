// SPDX-License-Identifier: BSD-3-Clause
#include "vtkFreeFormDeformation.h"

#include "Common/FilledArray.h"
#include "Common/Guard.h"
#include "Common/HostMemory.h"
#include "Common/ImageGrid.h"
#include "Common/Numbers.h"
#include "Common/SharedArray.h"
#include "Common/WorldAxes.h"
#include "Filters/Attached/DeformableVolume.h"
#include "Filters/Attached/Segmentation.h"
#include "Filters/Deformation/LatticeExtremes.h"
#include "Filters/Deformation/Replay.h"
#include "Filters/Fields/BaseLattice.h"
#include "Filters/Measured/EvidenceArray.h"
#include "Filters/Traces/StrokeMarks.h"

#include "vtkCellData.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"

#include <cmath>

using namespace brainshift;

struct vtkFreeFormDeformation::State
{
  std::vector<double> StrokeNumbers;
  Replay StrokeReplay;
  SharedArrays PointArrays;
  SharedArrays CellArrays;
  Deformation LastGood;
  bool HasLastGood = false;
  double MinimumJacobian = 1.0;
  bool MinimumJacobianKnown = false;
  bool IsProved = false; // the guard's limit holds for the last good deformation
  vtkNew<vtkDoubleArray> StrokeShares;
  vtkNew<vtkDoubleArray> StrokeReaches;
  SegmentationSource Segmentations;
  SegmentationSource Masks{ MaskLabelsName };
  Segmentation LastSegmentation;
  StrokeMarker Marker;
  StrokeMarks LastMarks;
  std::string TooFine;   // strokes for the lattice: a sentence
  std::string OtherFit;  // the base lattice was fitted for another deformation: a sentence
  std::string OtherMask; // the base lattice was drawn with another mask: a sentence
  std::string Sides;     // the base lattice may be of another world: a sentence
  std::vector<std::string> Warned;
  bool WarnedOfMask = false; // that it holds strokes back

  // The figures of a fit for other settings do not hold for this bend.
  void judgeBase(vtkImageData* base, const Lattice& start)
  {
    this->OtherFit = wordsOnFittedFor(base, start, this->LastGood.samples);
    this->OtherMask = wordsOnDrawnWith(base, start, this->LastGood.samples);
    this->LastGood.deviations =
      drawnDeviations(this->OtherFit.empty() ? base : nullptr, start, this->LastGood);
  }
};

namespace
{
constexpr int SegmentationPort = 3;

// Throws a Problem on what keeps this volume from being deformed.
void requireVolume(const Grid& volume)
{
  if (glm::any(glm::lessThan(volume.dimensions, glm::ivec3(2))))
  {
    throw Problem("The volume has " + sizeText(glm::dvec3(volume.dimensions)) +
      " points; it must have at least 2 along each axis");
  }
  requirePosition(volume, "The volume's ");
}

constexpr const char* BentAlready =
  "The volume already carries a deformation, which remains. Free-Form Deformation cannot bend a "
  "bent volume: add the strokes to the first Free-Form Deformation, or put Bake Deformation "
  "between the two";
}

vtkStandardNewMacro(vtkFreeFormDeformation);
brainshiftGuardRequestsMacro(vtkFreeFormDeformation);

vtkFreeFormDeformation::vtkFreeFormDeformation()
  : Internal(std::make_unique<State>())
{
  this->SetNumberOfInputPorts(SegmentationPort + 1);
}

vtkFreeFormDeformation::~vtkFreeFormDeformation() = default;

void vtkFreeFormDeformation::SetStrokeNumbers(const std::vector<double>& numbers)
{
  if (this->Internal->StrokeNumbers != numbers)
  {
    this->Internal->StrokeNumbers = numbers;
    this->Modified();
  }
}

void vtkFreeFormDeformation::SetLatticeConnection(vtkAlgorithmOutput* lattice)
{
  this->SetInputConnection(BasePort, lattice);
}

void vtkFreeFormDeformation::SetSegmentationConnection(vtkAlgorithmOutput* segmentation)
{
  this->SetInputConnection(SegmentationPort, segmentation);
}

int vtkFreeFormDeformation::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  // The other inputs are read everywhere, whichever piece of the volume is asked for.
  for (const int port : { BasePort, MaskPort, SegmentationPort })
  {
    updateWholeExtent(inputs[port]->GetInformationObject(0));
  }
  return this->Superclass::RequestUpdateExtent(request, inputs, outputs);
}

int vtkFreeFormDeformation::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkImageData* volume = vtkImageData::GetData(inputs[0]);
  vtkImageData* output = vtkImageData::GetData(outputs);
  output->ShallowCopy(volume);
  if (carriesDeformation(volume))
  {
    vtkErrorMacro(<< BentAlready << ".");
    return 1;
  }
  const Grid volumeGrid = wholeGridOf(volume, inputs[0]->GetInformationObject(0));
  requireVolume(volumeGrid);
  const std::string problem = sentenceThrownBy("Free-Form Deformation", [&] {
    this->Bend(volumeGrid, vtkImageData::GetData(inputs[BasePort]),
      vtkImageData::GetData(inputs[MaskPort]), vtkImageData::GetData(inputs[SegmentationPort]));
  });
  if (!problem.empty())
  {
    vtkErrorMacro(<< problem << ". The deformation stays as it was.");
  }
  this->Internal->Sides =
    wordsOnSidesOf({ "the lattice", worldAxesOf(vtkImageData::GetData(inputs[BasePort])) }, volume);
  this->TellWarnings();
  State& state = *this->Internal;
  state.PointArrays.share(output->GetPointData());
  state.CellArrays.share(output->GetCellData());
  attach(output, state.LastGood);
  attachSegmentation(output, state.LastSegmentation);
  attachMarks(output, state.LastMarks);
  return 1;
}

void vtkFreeFormDeformation::RequireProperties() const
{
  const double* const interest = this->PointOfInterest;
  if (!std::all_of(interest, interest + 3, [](double mm) { return std::isfinite(mm); }))
  {
    throw Problem("Point Of Interest is " + numberText(interest[0]) + " " +
      numberText(interest[1]) + " " + numberText(interest[2]) + " mm; its numbers must be finite");
  }
  if (std::isnan(this->Strength))
  {
    throw Problem("Strength is not a number; it must be from 0 to 1");
  }
}

// Runs the strokes, with progress.
void vtkFreeFormDeformation::ReplayStrokes(const Lattice& start, const std::vector<Stroke>& strokes)
{
  // CheckAbort would take the output away, and with it the last picture.
  Replay& replay = this->Internal->StrokeReplay;
  try
  {
    replay.run(start, strokes, { this->GuardFolding, this->GetSamples() }, [this](double fraction) {
      this->UpdateProgress(fraction);
      return !this->GetAbortExecute();
    });
  }
  catch (...)
  {
    replay = Replay(); // it may have stopped between two strokes
    throw;
  }
  if (!replay.isWhole())
  {
    throw Problem("Free-Form Deformation was stopped after " + std::to_string(replay.count()) +
      " of " + std::to_string(strokes.size()) + " strokes. The next change continues from there");
  }
  requireDisplacements(replay.result(), "the strokes");
}

void vtkFreeFormDeformation::Bend(
  const Grid& volumeGrid, vtkImageData* base, vtkImageData* maskImage, vtkImageData* segments)
{
  State& state = *this->Internal;
  if (!state.HasLastGood)
  {
    state.LastGood.lattice = makeLattice(this->LatticeGrid(volumeGrid), 0);
    state.HasLastGood = true;
  }
  this->RequireProperties();
  const std::vector<Stroke> strokes = strokesFromNumbers(state.StrokeNumbers);
  Lattice start = this->MakeLattice(volumeGrid, maskImage);
  addBase(start, base);
  Segmentation segmentation = state.Segmentations.find(segments ? segments : maskImage, volumeGrid);
  this->ReplayStrokes(start, strokes);
  segmentation.chosen = segments ? std::vector<int>() : this->ChosenLabels();
  if (maskImage)
  {
    segmentation.moving = this->ChosenLabels();
  }
  if (maskImage && segments && segments != maskImage)
  {
    const Segmentation mask = state.Masks.find(maskImage, volumeGrid);
    segmentation.mask = mask.labels;
    segmentation.maskGrid = mask.grid;
  }
  state.LastSegmentation = segmentation;
  Lattice result = state.StrokeReplay.result();
  std::swap(state.LastGood.lattice, result); // all of it or nothing
  state.TooFine = strokesTooFine(strokes, start.grid);
  state.LastGood.samples = this->GetSamples();
  state.LastGood.inverse =
    this->Inverse ? brainshift::Inverse::Negated : brainshift::Inverse::Exact;
  state.LastGood.strength = this->Strength;
  state.judgeBase(base, start);
  const std::vector<double> settings{ double(this->GuardFolding), double(this->GetSamples()),
    double(this->Inverse), this->Strength };
  state.LastMarks = state.Marker.marksOf(start, settings, state.StrokeNumbers);
  state.MinimumJacobianKnown = false;
  // The guard's proof is for the full strength.
  state.IsProved =
    this->GuardFolding && this->Strength == 1.0 && state.StrokeReplay.foldedCells() == 0;
}

void vtkFreeFormDeformation::TellWarnings()
{
  State& state = *this->Internal;
  std::vector<std::string> warnings;
  if (const int cells = state.StrokeReplay.foldedCells())
  {
    warnings.push_back("The base lattice folds by itself: the Jacobian determinant is below " +
      roundedText(SmallestGuardedJacobian) + " in " + std::to_string(cells) +
      " of its cells. Strokes are not shortened there");
  }
  if (const auto& mask = state.LastGood.lattice.mask;
    mask && *std::max_element(mask->values.begin(), mask->values.end()) == 0.0f)
  {
    warnings.push_back("The mask leaves no tissue to move: it is nowhere wider than two nodes of "
                       "the refined field. Raise Lattice Dimensions or Samples");
  }
  for (const std::string& words : { state.OtherFit, state.OtherMask, state.Sides, state.TooFine })
  {
    if (!words.empty())
    {
      warnings.push_back(words);
    }
  }
  for (const std::string& warning : warnings)
  {
    if (std::find(state.Warned.begin(), state.Warned.end(), warning) == state.Warned.end())
    {
      warn(this, warning);
    }
  }
  state.Warned = warnings;
  // More strokes of this kind do not interrupt again: the list of strokes marks each of them.
  const std::string held = state.StrokeReplay.strokesInFeather();
  if (!held.empty() && !state.WarnedOfMask)
  {
    warn(this, held);
  }
  state.WarnedOfMask = !held.empty();
}

double vtkFreeFormDeformation::GetMaximumDisplacement()
{
  const State& state = *this->Internal;
  return state.LastGood.strength * maximumDisplacement(state.LastGood.lattice);
}

double vtkFreeFormDeformation::GetMinimumJacobian()
{
  State& state = *this->Internal;
  if (!state.MinimumJacobianKnown && state.HasLastGood)
  {
    guarded(this, [&] {
      // Both are proved, so the larger one holds.
      state.MinimumJacobian = std::max(minimumJacobian(effectiveLattice(state.LastGood)),
        state.IsProved ? static_cast<double>(SmallestGuardedJacobian) : -HUGE_VAL);
      state.MinimumJacobianKnown = true;
    });
  }
  return state.MinimumJacobian;
}

int vtkFreeFormDeformation::GetShortenedStrokes() const
{
  const std::vector<double>& fractions = this->Internal->StrokeReplay.fractions();
  return static_cast<int>(std::count_if(
    fractions.begin(), fractions.end(), [](double fraction) { return fraction < 1.0; }));
}

vtkDoubleArray* vtkFreeFormDeformation::GetStrokeShares()
{
  return filled(this->Internal->StrokeShares, this->Internal->StrokeReplay.fractions());
}

vtkDoubleArray* vtkFreeFormDeformation::GetStrokeReaches()
{
  return filled(this->Internal->StrokeReaches, this->Internal->StrokeReplay.achieved());
}

int vtkFreeFormDeformation::GetAppliedStrokes() const
{
  return this->Internal->StrokeReplay.applied();
}

void vtkFreeFormDeformation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Inverse: " << (this->Inverse ? "Negated" : "Exact") << "\n"
     << indent << "Strength: " << this->Strength << "\n"
     << indent << "PointOfInterest: " << this->PointOfInterest[0] << " " << this->PointOfInterest[1]
     << " " << this->PointOfInterest[2] << "\n"
     << indent << "GuardFolding: " << this->GuardFolding << "\n"
     << indent << "Strokes: " << this->Internal->StrokeNumbers.size() / NumbersPerStroke << "\n";
}

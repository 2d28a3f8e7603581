// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRegistrationRun.h"

#include "Common/Guard.h"
#include "Common/HostMemory.h"
#include "Common/ImageGrid.h"
#include "Common/Numbers.h"
#include "Filters/Attached/ReferenceVolume.h"
#include "Filters/Register/Alignment.h"
#include "Filters/Register/Refinement.h"
#include "Filters/Register/Trust.h"
#include "Filters/Registered/ComparedVoxels.h"
#include "Filters/Registered/RegisteredSource.h"

#include "vtkAlgorithm.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

using namespace brainshift;

struct vtkRegistrationRun::Running
{
  std::unique_ptr<KeptMemory> Kept; // until the checks are finished, or nothing goes on
  std::unique_ptr<Alignment> Rigid;
  std::unique_ptr<Refinement> Elastic;
  std::vector<glm::vec3> Start;      // displacements of the control points, mm, world axes
  std::string Outside;               // what does not count, in words
  std::string Coarser;               // why finer voxels are not compared, without a full stop
  glm::dvec3 ReferenceMiddle{ 0.0 }; // mm, world, where the alignment begins

  RefinementPlan Plan; // of the checks, too
  RegisteredPair Pair; // of an alignment
  Lattice Bent;        // the deformation of an alignment
  std::unique_ptr<Verification> Checks;

  // The best result so far, while the refinement goes on because parts, or all, belong elsewhere.
  Lattice From; // where a refinement begins
  RefinementSettings Settings;
  std::unique_ptr<Refinement> Best;
  std::unique_ptr<Verification> BestChecks;
  int Rounds = 0;
  int OtherSteps = 0;    // of the rounds that Elastic did not make
  Elsewhere AtFirst;     // of the first result
  Elsewhere Brought;     // the same, if a later result is kept
  double NearbyMm = 0.0; // from the first result to a place that matches better; 0: there is none
  double MovedMm = 0.0;  // the same, if a later result is kept

  void BeginRigid(RegisteredSource source, const RegisteredGrids& grids, int starts);
  void BeginChecks();
  void FinishChecks();
  void FinishBlocks();
  void FinishNearby();
  void GoOn(const Controls& motion);
  void KeepBest();
  bool IsFinished() const;
  double Done() const;
};

vtkStandardNewMacro(vtkRegistrationRun);

namespace
{
// Tests of an alignment start up to 20 mm and 15 degrees away; the middle of the compared tissue
// then moves a little farther than that of the reference.
constexpr double FarthestShiftMm = 24.0;
constexpr double FarthestDegrees = 17.0;

constexpr int MostRounds = 2; // that go on from where parts belong

// The refinement goes on from another place if the gain over it, a fraction, is less. The search
// takes an eighth of the samples: by chance it found places beside right results that cost 1.2 %
// less.
constexpr double BetterPlace = -0.04;

// The progress at the end of each round. Few refinements go on; the others end early.
constexpr std::array<double, MostRounds + 1> RoundEnds{ 0.8, 0.92, 1.0 };

constexpr double RegistrationPart = 0.8; // of the progress; the rest are the checks

// Limits of the checks of an alignment, mm. Tissue may be bent, so that halves differ more than
// after a refinement.
constexpr double AlignHalvesMm = 8.0;
constexpr double AlignOtherMm = 3.0;
constexpr int StillSides = 8; // control points of a lattice that bends nothing

// The least distance of samples, mm.
double finestOf(const RefinementPlan& plan)
{
  double finest = plan.levels.front().spacingMm;
  for (const RefinementLevel& level : plan.levels)
  {
    finest = std::min(finest, level.spacingMm);
  }
  return finest;
}

std::string rounded(double value, int digits = 0)
{
  std::ostringstream text;
  text << std::fixed << std::setprecision(digits) << value;
  return text.str();
}

void fill(vtkDoubleArray* array, const std::vector<double>& values)
{
  array->SetNumberOfValues(static_cast<vtkIdType>(values.size()));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
}
}

void vtkRegistrationRun::Running::BeginRigid(
  RegisteredSource source, const RegisteredGrids& grids, int starts)
{
  this->ReferenceMiddle = middleOf(grids.reference);
  this->Plan = similarities().front().plan;
  this->Plan.check.halvesMm = AlignHalvesMm;
  this->Plan.check.otherMm = AlignOtherMm;
  this->Plan.check.blocks = {}; // tissue may be bent
  this->Bent = source.bent
    ? effectiveLattice(*source.bent)
    : makeLattice(withDimensions(grids.rest, glm::ivec3(StillSides)), KernelCatmullRom);
  this->Pair = std::move(source.pair);
  AlignmentSettings search;
  search.starts = starts;
  this->Rigid =
    std::make_unique<Alignment>(this->Pair, source.bent ? &this->Bent : nullptr, search);
}

void vtkRegistrationRun::Running::BeginChecks()
{
  if (this->Elastic)
  {
    this->Checks = std::make_unique<Verification>(this->Elastic->takePair(), this->From,
      this->Elastic->lattice(), this->Plan, this->Elastic->takeLevel());
    return;
  }
  const RigidPose motion = this->Rigid->motion();
  for (Grid* grid :
    { &this->Pair.reference.grid, &this->Pair.cavity.grid, &this->Pair.referenceUnknown.grid })
  {
    grid->origin = motion.apply(grid->origin);
    grid->direction = motion.rotation * grid->direction;
  }
  this->Checks =
    std::make_unique<Verification>(std::move(this->Pair), this->Bent, this->Bent, this->Plan);
}

void vtkRegistrationRun::Running::FinishChecks()
{
  if (!this->Elastic || this->Rounds > MostRounds)
  {
    return;
  }
  if (this->Plan.check.rivalGain > 0.0)
  {
    this->FinishNearby();
  }
  else
  {
    this->FinishBlocks();
  }
}

// Parts of the volume that belong elsewhere are brought there, and the refinement goes on from it.
// The result of which the least belongs elsewhere is kept.
void vtkRegistrationRun::Running::FinishBlocks()
{
  const Elsewhere found = this->Checks->elsewhere();
  if (this->Best && found.ml >= this->BestChecks->elsewhere().ml)
  {
    this->KeepBest();
    return;
  }
  if (this->Rounds > 0)
  {
    this->Brought = this->AtFirst;
  }
  else
  {
    this->AtFirst = found;
  }
  ++this->Rounds;
  if (found.ml > 0.0 && this->Rounds <= MostRounds)
  {
    this->GoOn(this->Checks->motionOfBlocks());
  }
}

// The refinement goes on from a place nearby that matches clearly better. The result that stands
// out more from other places is kept.
void vtkRegistrationRun::Running::FinishNearby()
{
  const auto gainOf = [](const Verification& checks) {
    return checks.figures().rivalGain.value_or(std::numeric_limits<double>::max());
  };
  const double gain = gainOf(*this->Checks);
  if (this->Best && !(gain > gainOf(*this->BestChecks)))
  {
    this->KeepBest();
    return;
  }
  if (this->Rounds > 0)
  {
    this->MovedMm = this->NearbyMm;
  }
  else
  {
    this->NearbyMm = gain < BetterPlace ? this->Checks->figures().rivalMm : 0.0;
  }
  ++this->Rounds;
  if (gain < BetterPlace && this->Rounds <= MostRounds)
  {
    this->GoOn(Controls(this->Checks->figures().rivalMotion));
  }
}

void vtkRegistrationRun::Running::GoOn(const Controls& motion)
{
  this->OtherSteps += this->Elastic->progress().steps;
  this->Best = std::move(this->Elastic);
  this->BestChecks = std::move(this->Checks);
  this->Elastic =
    std::make_unique<Refinement>(this->BestChecks->takePair(), this->From, this->Settings);
  this->Elastic->beginAt(this->Best->lattice(), motion);
}

// The present round found nothing better, or is stopped.
void vtkRegistrationRun::Running::KeepBest()
{
  this->OtherSteps += this->Elastic->progress().steps - this->Best->progress().steps;
  this->Elastic = std::move(this->Best);
  this->Checks = std::move(this->BestChecks);
  this->Rounds = MostRounds + 1;
}

bool vtkRegistrationRun::Running::IsFinished() const
{
  return (this->Rigid && this->Rigid->progress().isFinished) ||
    (this->Elastic && this->Elastic->progress().isFinished);
}

double vtkRegistrationRun::Running::Done() const
{
  const double done = this->Rigid ? this->Rigid->progress().done : this->Elastic->progress().done;
  const double part = RegistrationPart * done +
    (1.0 - RegistrationPart) * (this->Checks ? this->Checks->done() : 0.0);
  const bool mayGoOn = this->Plan.check.blocks.make || this->Plan.check.rivalGain > 0.0;
  if (this->Rigid || !mayGoOn || this->Rounds > MostRounds)
  {
    return part;
  }
  const double begin = this->Rounds > 0 ? RoundEnds.at(this->Rounds - 1) : 0.0;
  return begin + part * (RoundEnds.at(this->Rounds) - begin);
}

vtkRegistrationRun::vtkRegistrationRun()
  : Internal(std::make_unique<Running>())
{
  for (const brainshift::Similarity& similarity : similarities())
  {
    const char* separator = this->SimilarityNames.empty() ? "" : "\n";
    this->SimilarityNames += separator + std::string(similarity.name);
    this->SimilarityLabels += separator + std::string(similarity.label);
    this->SimilarityTooltips += separator + std::string(similarity.tooltip);
  }
}

vtkRegistrationRun::~vtkRegistrationRun() = default;

void vtkRegistrationRun::SetSimilarity(int similarity)
{
  const int last = static_cast<int>(similarities().size()) - 1;
  const int clamped = std::clamp(similarity, 0, last);
  if (this->Similarity != clamped)
  {
    this->Similarity = clamped;
    this->Modified();
  }
}

void vtkRegistrationRun::SetStarts(int starts)
{
  const int clamped = std::clamp(starts, 1, MostStarts);
  if (this->Starts != clamped)
  {
    this->Starts = clamped;
    this->Modified();
  }
}

void vtkRegistrationRun::SetSource(vtkAlgorithm* source)
{
  this->Source = source;
}

void vtkRegistrationRun::Begin(bool bends)
{
  *this->Internal = {};
  vtkImageData* part =
    vtkImageData::SafeDownCast(this->Source ? this->Source->GetOutputDataObject(0) : nullptr);
  const brainshift::Similarity& similarity = similarities()[this->Similarity];
  const ComparedVoxels compared =
    comparedVoxels(part, part ? this->Source->GetOutputInformation(0) : nullptr,
      bends ? finestOf(similarity.plan) : AlignmentSettings().levelsMm.back());
  vtkImageData* image = compared.image;
  if (!image)
  {
    return; // the first MPI rank registers
  }
  this->Internal->Coarser = compared.remark;
  const RegisteredGrids grids = findGrids(image);
  if (!(this->Stiffness > 0.0)) // also rejects NaN
  {
    throw brainshift::Problem(
      "Stiffness is " + numberText(this->Stiffness) + "; it must be above 0");
  }
  RefinementSettings settings;
  settings.plan = similarity.plan;
  settings.stiffness = this->Stiffness;
  this->Internal->Plan = similarity.plan;
  settings.starts = this->Starts;
  this->OverlapOf = bends ? similarity.overlapOf : "the volume";
  const double voxels =
    sizeof(float) * static_cast<double>(grids.rest.count() + grids.reference.count());
  requireHostMemory("The registration of " + sizeText(grids.rest.dimensions) + " voxels",
    voxels +
      std::max(Verification::bytes(grids.rest, grids.reference, {}, similarity.plan),
        bends ? Refinement::bytes(grids.rest, grids.reference, {}, settings)
              : Alignment::bytes(grids.rest, grids.reference)));
  this->Internal->Kept = std::make_unique<KeptMemory>();
  RegisteredSource source = readSource(image);
  if (bends)
  {
    compareMovingTissue(image, source.pair);
  }
  requireContent(source.pair);
  this->Internal->Outside = source.pair.cavity.inside.empty() ? "" : " outside the cavity";
  if (bends)
  {
    requireRefinable(source.bent.get(), compared.whole);
    const Lattice& start = source.bent->lattice;
    requireHostMemory("The refinement of " + sizeText(start.grid.dimensions) + " control points",
      Refinement::bytes(grids.rest, grids.reference, start.grid, settings));
    settings.samples = source.bent->samples;
    this->Internal->Start = start.displacements;
    this->Internal->From = start;
    this->Internal->Settings = settings;
    this->Internal->Elastic = std::make_unique<Refinement>(std::move(source.pair), start, settings);
    return;
  }
  this->Internal->BeginRigid(std::move(source), grids, this->Starts);
}

void vtkRegistrationRun::BeginGuarded(bool bends)
{
  this->Problem = "Memory ran out"; // if something else than a Problem is thrown
  guarded(this, [this, bends] {
    this->Problem = problemOf([this, bends] { this->Begin(bends); });
    this->Report();
  });
  if (!this->Problem.empty())
  {
    this->Internal->Kept = nullptr;
  }
}

void vtkRegistrationRun::BeginAlignment()
{
  this->BeginGuarded(false);
}

void vtkRegistrationRun::BeginRefinement()
{
  this->BeginGuarded(true);
}

void vtkRegistrationRun::Step()
{
  const bool isDone = guarded(this, false, [this] {
    this->Advance();
    this->Report();
    return true;
  });
  if (!isDone)
  {
    *this->Internal = {};
    this->Problem = "The registration stopped; see the messages";
  }
}

void vtkRegistrationRun::Stop()
{
  guarded(this, [this] {
    this->Internal->Kept = nullptr;
    if (this->Internal->Best)
    {
      this->Internal->KeepBest();
      this->Report();
    }
  });
}

void vtkRegistrationRun::Advance()
{
  Running& run = *this->Internal;
  if (run.Checks)
  {
    if (!run.Checks->step())
    {
      run.FinishChecks();
    }
    return;
  }
  if (run.Rigid)
  {
    run.Rigid->step();
  }
  if (run.Elastic)
  {
    run.Elastic->step();
  }
  this->Report();
  if (run.IsFinished() && this->Refusal.empty())
  {
    run.BeginChecks();
  }
}

void vtkRegistrationRun::Warn(const std::string& sentence)
{
  this->Warning += (this->Warning.empty() ? "" : "\n") + sentence;
}

void vtkRegistrationRun::Report()
{
  this->Refusal = {};
  this->Warning = {};
  this->Trust = nameOf(brainshift::Trust::Unchecked);
  if (!this->Internal->Rigid && !this->Internal->Elastic)
  {
    return;
  }
  if (this->Internal->Rigid)
  {
    this->ReportAlignment();
  }
  else
  {
    this->ReportRefinement();
  }
  if (!this->Internal->Coarser.empty())
  {
    this->Warn("Coarser voxels are compared than there are: " + this->Internal->Coarser + ".");
  }
  const bool isRefused = !this->Refusal.empty();
  const bool isDone = this->Internal->IsFinished() &&
    (isRefused || (this->Internal->Checks && this->Internal->Checks->isFinished()));
  this->Done = isDone ? 1.0 : this->Internal->Done();
  this->Finished = isDone ? 1 : 0;
  this->Checking = this->Internal->Checks && !isDone ? 1 : 0;
  if (isDone)
  {
    this->Internal->Kept = nullptr;
  }
  if (isDone && !isRefused)
  {
    this->ReportChecks();
  }
}

void vtkRegistrationRun::ReportChecks()
{
  Verdict verdict = this->Internal->Checks->verdict();
  if (this->Internal->Brought.ml > 0.0 && verdict.trust != brainshift::Trust::Unchecked)
  {
    verdict.lower(brainshift::Trust::Doubtful, broughtReason(this->Internal->Brought));
  }
  if (this->Internal->MovedMm > 0.0 && verdict.trust == brainshift::Trust::Doubtful)
  {
    verdict.lower(brainshift::Trust::Failed, movedReason(this->Internal->MovedMm));
  }
  std::string reasons;
  for (const std::string& reason : verdict.reasons)
  {
    reasons += (reasons.empty() ? "" : " ") + reason;
  }
  if (verdict.trust == brainshift::Trust::Failed && this->KeepFailed == 0)
  {
    this->Refusal = "The result failed its checks. " + reasons.substr(0, reasons.size() - 1);
  }
  // A warning that is known without them makes the result doubtful, too.
  if (!this->Warning.empty() && verdict.trust == brainshift::Trust::Good)
  {
    verdict.trust = brainshift::Trust::Doubtful;
  }
  this->Trust = nameOf(verdict.trust);
  for (const std::string& reason : verdict.reasons)
  {
    this->Warn(reason);
  }
}

void vtkRegistrationRun::ReportAlignment()
{
  const Alignment& rigid = *this->Internal->Rigid;
  const AlignmentProgress& at = rigid.progress();
  this->Steps = at.steps;
  this->Level = at.level;
  this->Overlap = at.overlap;
  this->Information = at.information;
  this->InformationBefore = at.informationAtStart;
  this->Shift = rigid.shiftMm();
  this->Rotation = rigid.rotationDegrees();
  if (this->Steps > 0 && this->Overlap < Alignment::LeastOverlap)
  {
    this->Refusal = "Only " + percentText(this->Overlap) +
      " of the volume has a partner in the reference" + this->Internal->Outside + "; at least " +
      percentText(Alignment::LeastOverlap) + " must have one. Move the reference closer first";
  }
  if (this->Shift > FarthestShiftMm || this->Rotation > FarthestDegrees)
  {
    this->Warn("The reference was moved by " + rounded(this->Shift) + " mm and " +
      rounded(this->Rotation) +
      " degrees. Align was tested only for motions of up to 20 mm and 15 degrees. Check the "
      "position of the reference.");
  }
}

void vtkRegistrationRun::ReportRefinement()
{
  const RefinementProgress& at = this->Internal->Elastic->progress();
  this->Steps = this->Internal->OtherSteps + at.steps;
  if (at.steps > 0 || this->Internal->OtherSteps == 0) // else it went on and compared nothing yet
  {
    this->Level = at.level;
    this->Overlap = at.overlap;
    this->Cost = at.cost;
    this->CostBefore = at.costAtStart;
    this->LongestMove = at.movedMm;
    this->StepFraction = at.stepFraction;
  }
  double sum = 0.0;
  this->LargestChange = 0.0;
  const std::vector<glm::vec3>& now = this->Internal->Elastic->lattice().displacements;
  for (std::size_t i = 0; i < now.size(); ++i)
  {
    const double change = glm::distance(glm::dvec3(now[i]), glm::dvec3(this->Internal->Start[i]));
    this->LargestChange = std::max(this->LargestChange, change);
    sum += change;
  }
  this->MeanChange = sum / static_cast<double>(std::max<std::size_t>(1, now.size()));
  if (at.steps > 0 && !(this->Overlap > 0.0)) // also rejects NaN
  {
    this->Refusal = "The volume and the reference do not overlap" + this->Internal->Outside;
  }
  else if (!std::isfinite(at.cost))
  {
    this->Refusal = "The cost is no finite number, so the volumes cannot be compared";
  }
  if (this->Cost > this->CostBefore)
  {
    this->Warn("The cost is higher than before the refinement: " + rounded(this->Cost, 3) +
      " instead of " + rounded(this->CostBefore, 3) + "; undo it.");
  }
  if (at.steps > 0 && this->Overlap < Alignment::LeastOverlap)
  {
    this->Warn("Only " + percentText(this->Overlap) + " of " + this->OverlapOf +
      " has a partner in the reference; at least " + percentText(Alignment::LeastOverlap) +
      " should.");
  }
}

vtkDoubleArray* vtkRegistrationRun::GetMotion()
{
  std::vector<double> rows;
  if (this->Internal->Rigid)
  {
    const RigidPose motion = this->Internal->Rigid->motion();
    for (int row = 0; row < 3; ++row)
    {
      for (int column = 0; column < 3; ++column)
      {
        rows.push_back(motion.rotation[column][row]);
      }
      rows.push_back(motion.translation[row]);
    }
    rows.insert(rows.end(), { 0.0, 0.0, 0.0, 1.0 });
  }
  fill(this->Motion, rows);
  return this->Motion;
}

vtkDoubleArray* vtkRegistrationRun::GetPlacement()
{
  std::vector<double> numbers;
  if (this->Internal->Rigid)
  {
    const double* r = this->StartRotation;
    const double* t = this->StartTranslation;
    RigidMotion start;
    start.rotation = { r[0], r[1], r[2] };
    start.translation = { t[0], t[1], t[2] };
    start.middle = this->Internal->ReferenceMiddle - start.translation; // the centre of rotation
    const RigidPose motion = this->Internal->Rigid->motion();
    const RigidMotion found = followedBy(start, motion.rotation, motion.translation);
    numbers = { found.rotation.x, found.rotation.y, found.rotation.z, found.translation.x,
      found.translation.y, found.translation.z };
  }
  fill(this->Placement, numbers);
  return this->Placement;
}

vtkDoubleArray* vtkRegistrationRun::GetControlPoints()
{
  std::vector<double> numbers;
  if (this->Internal->Elastic)
  {
    for (const glm::vec3& d : this->Internal->Elastic->lattice().displacements)
    {
      numbers.insert(numbers.end(), { d.x, d.y, d.z });
    }
  }
  fill(this->ControlPoints, numbers);
  return this->ControlPoints;
}

void vtkRegistrationRun::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Similarity: " << this->Similarity << "\n"
     << indent << "Stiffness: " << this->Stiffness << "\n"
     << indent << "KeepFailed: " << this->KeepFailed << "\n"
     << indent << "Starts: " << this->Starts << "\n"
     << indent << "Problem: " << this->Problem << "\n";
}

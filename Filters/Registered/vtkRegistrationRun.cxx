// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRegistrationRun.h"

#include "Common/Guard.h"
#include "Common/HostMemory.h"
#include "Common/ImageGrid.h"
#include "Filters/Attached/ReferenceVolume.h"
#include "Filters/Register/Alignment.h"
#include "Filters/Register/Refinement.h"
#include "Filters/Register/Similarity.h"
#include "Filters/Registered/RegisteredSource.h"

#include "vtkAlgorithm.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkObjectFactory.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cstddef>
#include <iomanip>
#include <sstream>
#include <utility>
#include <vector>

using namespace brainshift;

struct vtkRegistrationRun::Running
{
  std::unique_ptr<Alignment> Rigid;
  std::unique_ptr<Refinement> Elastic;
  std::vector<glm::vec3> Start;      // displacements of the control points, mm, world axes
  glm::dvec3 ReferenceMiddle{ 0.0 }; // mm, world, where the alignment begins
};

vtkStandardNewMacro(vtkRegistrationRun);

namespace
{
constexpr double PlaceTolerance = 1e-3; // voxels

// Tests of an alignment start up to 20 mm and 15 degrees away; the middle of what is compared then
// moves a little farther than that of the reference.
constexpr double FarthestShiftMm = 24.0;
constexpr double FarthestDegrees = 17.0;

std::string rounded(double value, int digits = 0)
{
  std::ostringstream text;
  text << std::fixed << std::setprecision(digits) << value;
  return text.str();
}

std::string percent(double fraction)
{
  return rounded(100.0 * fraction) + " %";
}

void fill(vtkDoubleArray* array, const std::vector<double>& values)
{
  array->SetNumberOfValues(static_cast<vtkIdType>(values.size()));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
}

// Why a refinement cannot begin with this bend; empty if it can.
std::string problemOf(const Deformation* bent)
{
  if (!bent)
  {
    return "The volume carries no deformation; Free-Form Deformation attaches one";
  }
  if (bent->strength != 1.0)
  {
    return "Strength is " + std::to_string(bent->strength) + "; a refinement needs 1";
  }
  return bent->inverse == Inverse::Exact
    ? ""
    : "The deformation has the negated inverse; a refinement needs the exact one";
}

// Why a refinement cannot begin with a lattice that lies elsewhere than the volume; or empty.
std::string problemOfPlace(const Grid& lattice, const Grid& rest)
{
  const glm::dvec3 first = rest.gridFromWorld(lattice.origin);
  const glm::dvec3 last = rest.gridFromWorld(lattice.worldFromGrid(lattice.dimensions - 1));
  const bool isSame = glm::all(glm::lessThan(glm::abs(first), glm::dvec3(PlaceTolerance))) &&
    glm::all(
      glm::lessThan(glm::abs(last - glm::dvec3(rest.dimensions - 1)), glm::dvec3(PlaceTolerance)));
  return isSame
    ? ""
    : "The volume was cropped or resampled after it was bent; a refinement needs all of it";
}
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

void vtkRegistrationRun::SetSource(vtkAlgorithm* source)
{
  this->Source = source;
}

std::string vtkRegistrationRun::Begin(bool bends)
{
  *this->Internal = {};
  vtkImageData* image =
    vtkImageData::SafeDownCast(this->Source ? this->Source->GetOutputDataObject(0) : nullptr);
  RegisteredGrids grids;
  std::string problem = findGrids(image, grids);
  // On several MPI ranks this rank holds a piece; registering it alone would be silently wrong.
  problem = problem.empty() ? problemOfPart(image, this->Source->GetOutputInformation(0)) : problem;
  if (!problem.empty())
  {
    return problem;
  }
  if (!(this->Stiffness > 0.0))
  {
    return "Stiffness is " + std::to_string(this->Stiffness) + "; it must be above 0";
  }
  RefinementSettings settings;
  const brainshift::Similarity& similarity = similarities()[this->Similarity];
  settings.plan = similarity.plan;
  settings.stiffness = this->Stiffness;
  this->OverlapOf = bends ? similarity.overlapOf : "the volume";
  const double voxels =
    sizeof(float) * static_cast<double>(grids.rest.count() + grids.reference.count());
  problem = hostMemoryProblem("The registration of " + sizeText(grids.rest.dimensions) + " voxels",
    voxels +
      (bends ? Refinement::bytes(grids.rest, grids.reference, {}, settings)
             : Alignment::bytes(grids.rest, grids.reference)));
  RegisteredSource source;
  problem = problem.empty() ? readSource(image, source) : problem;
  if (problem.empty() && bends)
  {
    problem = problemOf(source.bent.get());
    problem = problem.empty() ? problemOfPlace(source.bent->lattice.grid, grids.rest) : problem;
  }
  if (problem.empty() && bends)
  {
    const Grid& lattice = source.bent->lattice.grid;
    problem =
      hostMemoryProblem("The refinement of " + sizeText(lattice.dimensions) + " control points",
        Refinement::bytes(grids.rest, grids.reference, lattice, settings));
  }
  if (!problem.empty())
  {
    return problem;
  }
  if (bends)
  {
    settings.samples = source.bent->samples;
    this->Internal->Start = source.bent->lattice.displacements;
    this->Internal->Elastic =
      std::make_unique<Refinement>(std::move(source.pair), source.bent->lattice, settings);
    return {};
  }
  this->Internal->ReferenceMiddle = middleOf(grids.reference);
  const Lattice bent = source.bent ? effectiveLattice(*source.bent) : Lattice{};
  this->Internal->Rigid =
    std::make_unique<Alignment>(std::move(source.pair), source.bent ? &bent : nullptr);
  return {};
}

void vtkRegistrationRun::BeginAlignment()
{
  this->Problem = "Memory ran out"; // unless it gets to its end
  guarded(this, [this] {
    this->Problem = this->Begin(false);
    this->Report();
  });
}

void vtkRegistrationRun::BeginRefinement()
{
  this->Problem = "Memory ran out";
  guarded(this, [this] {
    this->Problem = this->Begin(true);
    this->Report();
  });
}

void vtkRegistrationRun::Step()
{
  const bool isDone = guarded(this, false, [this] {
    if (this->Internal->Rigid)
    {
      this->Internal->Rigid->step();
    }
    if (this->Internal->Elastic)
    {
      this->Internal->Elastic->step();
    }
    this->Report();
    return true;
  });
  if (!isDone)
  {
    *this->Internal = {};
    this->Problem = "The registration stopped; see the messages";
  }
}

void vtkRegistrationRun::Report()
{
  this->Refusal = {};
  this->Warning = {};
  if (this->Internal->Rigid)
  {
    this->ReportAlignment();
  }
  else if (this->Internal->Elastic)
  {
    this->ReportRefinement();
  }
}

void vtkRegistrationRun::ReportAlignment()
{
  const Alignment& rigid = *this->Internal->Rigid;
  const AlignmentProgress& at = rigid.progress();
  this->Finished = at.isFinished ? 1 : 0;
  this->Steps = at.steps;
  this->Level = at.level;
  this->Done = at.done;
  this->Overlap = at.overlap;
  this->Information = at.information;
  this->InformationBefore = at.informationAtStart;
  this->Shift = rigid.shiftMm();
  this->Rotation = rigid.rotationDegrees();
  if (this->Steps > 0 && this->Overlap < Alignment::LeastOverlap)
  {
    this->Refusal = percent(this->Overlap) + " of the volume is inside the reference; at least " +
      percent(Alignment::LeastOverlap) + " must be. Move the reference closer first";
  }
  if (this->Shift > FarthestShiftMm || this->Rotation > FarthestDegrees)
  {
    this->Warning = "The reference was moved by " + rounded(this->Shift) + " mm and " +
      rounded(this->Rotation) +
      " degrees. Align is tested only from up to 20 mm and 15 degrees "
      "away; check the position of the reference.";
  }
}

void vtkRegistrationRun::ReportRefinement()
{
  const RefinementProgress& at = this->Internal->Elastic->progress();
  this->Finished = at.isFinished ? 1 : 0;
  this->Steps = at.steps;
  this->Level = at.level;
  this->Done = at.done;
  this->Overlap = at.overlap;
  this->Cost = at.cost;
  this->CostBefore = at.costAtStart;
  this->LongestMove = at.movedMm;
  this->StepFraction = at.stepFraction;
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
  if (this->Steps > 0 && !(this->Overlap > 0.0)) // also rejects NaN
  {
    this->Refusal = "The volume and the reference do not overlap";
  }
  if (this->Cost > this->CostBefore)
  {
    this->Warning = "The cost is higher than before the refinement: " + rounded(this->Cost, 3) +
      " instead of " + rounded(this->CostBefore, 3) + "; undo it. ";
  }
  if (this->Steps > 0 && this->Overlap < Alignment::LeastOverlap)
  {
    this->Warning += "Only " + percent(this->Overlap) + " of " + this->OverlapOf +
      " has a partner in the reference; at least " + percent(Alignment::LeastOverlap) + " should. ";
  }
  this->Warning.erase(this->Warning.find_last_not_of(' ') + 1);
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
    start.middle = this->Internal->ReferenceMiddle - start.translation; // it turns about its middle
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
     << indent << "Problem: " << this->Problem << "\n";
}

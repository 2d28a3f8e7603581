// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRegistrationRun.h"

#include "Common/Guard.h"
#include "Common/HostMemory.h"
#include "Common/ImageGrid.h"
#include "Filters/Register/Alignment.h"
#include "Filters/Register/Refinement.h"
#include "Filters/Registered/RegisteredSource.h"

#include "vtkAlgorithm.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkObjectFactory.h"

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <utility>
#include <vector>

using namespace brainshift;

struct vtkRegistrationRun::Running
{
  std::unique_ptr<Alignment> Rigid;
  std::unique_ptr<Refinement> Elastic;
};

vtkStandardNewMacro(vtkRegistrationRun);

namespace
{
constexpr double PlaceTolerance = 1e-3; // voxels

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
}

vtkRegistrationRun::~vtkRegistrationRun() = default;

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
  // On several MPI ranks each has a part of the volume, and nobody would see that it is one.
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
  settings.stages = stagesOf(static_cast<SimilarityKind>(this->Similarity));
  settings.stiffness = this->Stiffness;
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
    this->Internal->Elastic =
      std::make_unique<Refinement>(std::move(source.pair), source.bent->lattice, settings);
    return {};
  }
  const Lattice bent = source.bent ? effectiveLattice(*source.bent) : Lattice{};
  this->Internal->Rigid =
    std::make_unique<Alignment>(std::move(source.pair), source.bent ? &bent : nullptr);
  return {};
}

void vtkRegistrationRun::BeginAlignment()
{
  this->Problem = "Memory ran out"; // unless it gets to its end
  guarded(this, [this] { this->Problem = this->Begin(false); });
}

void vtkRegistrationRun::BeginRefinement()
{
  this->Problem = "Memory ran out";
  guarded(this, [this] { this->Problem = this->Begin(true); });
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
    return true;
  });
  if (!isDone)
  {
    *this->Internal = {}; // without figures, a caller sees that it stopped
  }
}

vtkDoubleArray* vtkRegistrationRun::GetFigures()
{
  std::vector<double> figures;
  if (this->Internal->Rigid)
  {
    const Alignment& rigid = *this->Internal->Rigid;
    const AlignmentProgress& at = rigid.progress();
    figures = { double(at.isFinished), double(at.steps), double(at.level), at.comparedShare,
      at.information, at.informationAtStart, rigid.shiftMm(), rigid.turnDegrees(), at.done };
  }
  else if (this->Internal->Elastic)
  {
    const RefinementProgress& at = this->Internal->Elastic->progress();
    figures = { double(at.isFinished), double(at.steps), double(at.level), at.comparedShare,
      at.disagreement, at.disagreementAtStart, at.movedMm, at.share, at.done };
  }
  fill(this->Figures, figures);
  return this->Figures;
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

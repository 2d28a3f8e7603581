// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTransformReader.h"

#include "Common/Guard.h"
#include "Common/HostMemory.h"
#include "Common/Portions.h"
#include "Common/WorldAxes.h"
#include "Filters/Attached/DeformableVolume.h"
#include "Filters/Fields/BaseLattice.h"
#include "Filters/Fields/TransformLattice.h"
#include "Formats/Fields/FieldGap.h"
#include "Formats/Fields/FieldImage.h"
#include "Formats/Transforms/TransformFile.h"

#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <glm/gtc/type_ptr.hpp>

using namespace brainshift;

namespace
{
// Displacements of a map at the points of a grid; false if the user aborts.
bool sample(vtkAlgorithm* filter, const DirectedTransform& transform, brainshift::Direction wanted,
  const Grid& grid, std::vector<glm::vec3>& displacements)
{
  displacements.resize(grid.count());
  const auto points = static_cast<vtkIdType>(grid.count());
  return forPortions({ filter }, points, MappedOfThread, [&](vtkIdType from, vtkIdType to) {
    for (vtkIdType point = from; point < to; ++point)
    {
      const vtkIdType row = point / grid.dimensions.x;
      const glm::dvec3 index(
        point % grid.dimensions.x, row % grid.dimensions.y, row / grid.dimensions.y);
      const glm::dvec3 position = grid.worldFromGrid(index);
      displacements[point] = glm::vec3(transform.towards(wanted, position) - position);
    }
  });
}

}

struct vtkTransformReader::State
{
  std::vector<std::string> Later;
  std::vector<glm::dvec3> Points;
  PointTransform Chain;
  std::string Problem;
  std::string ProblemOfRun; // of the pipeline, after the files were read
  vtkMTimeType ReadAt = 0;  // the time of the properties that Chain and Problem belong to
  Grid OutputGrid;
  bool Good = false; // OutputGrid is known
  vtkNew<vtkDoubleArray> Mapped;
  vtkNew<vtkDoubleArray> MappedBack;
  vtkNew<vtkDoubleArray> Bounds;
  vtkNew<vtkDoubleArray> Rows;
};

vtkStandardNewMacro(vtkTransformReader);
brainshiftGuardRequestsMacro(vtkTransformReader);

vtkTransformReader::vtkTransformReader()
  : Internal(std::make_unique<State>())
{
  this->SetNumberOfInputPorts(1);
}

vtkTransformReader::~vtkTransformReader() = default;

int vtkTransformReader::CanReadFile(const char* fileName)
{
  return fileName && isTransformFile(fileName) ? 1 : 0;
}

void vtkTransformReader::AddLaterFileName(const char* fileName)
{
  if (fileName && *fileName)
  {
    this->Internal->Later.emplace_back(fileName);
    this->Modified();
  }
}

void vtkTransformReader::ClearLaterFileNames()
{
  this->Internal->Later.clear();
  this->Modified();
}

void vtkTransformReader::AddPoint(double x, double y, double z)
{
  this->Internal->Points.emplace_back(x, y, z);
}

void vtkTransformReader::ClearPoints()
{
  this->Internal->Points.clear();
}

const std::string& vtkTransformReader::Load()
{
  State& state = *this->Internal;
  if (state.ReadAt == this->GetMTime())
  {
    return state.Problem;
  }
  TransformFiles files{ { this->FileName }, this->FixedImage, this->MovingImage,
    static_cast<brainshift::MatrixProgram>(this->MatrixProgram) };
  files.names.insert(files.names.end(), state.Later.begin(), state.Later.end());
  state.Chain = {};
  state.Problem = sentenceThrownBy("Transform Reader", [&] {
    throwIfAny(this->FileName.empty() ? "FileName is empty; it must name a transform" : "");
    state.Chain = readTransformFiles(files);
  });
  if (this->World == LPS)
  {
    reverseXY(state.Chain);
  }
  if (this->FieldsBetween == Held)
  {
    holdFields(state.Chain);
  }
  state.ReadAt = this->GetMTime();
  return state.Problem;
}

std::string vtkTransformReader::GetProblem()
{
  const std::string& problem = this->Load();
  return problem.empty() ? this->Internal->ProblemOfRun : problem;
}

const PointTransform& vtkTransformReader::GetChain()
{
  static const PointTransform identity;
  return this->Load().empty() ? this->Internal->Chain : identity;
}

std::string vtkTransformReader::GetKind()
{
  return this->Load().empty() ? kindOf(this->Internal->Chain) : std::string();
}

bool vtkTransformReader::GetKnowsSides()
{
  return this->Load().empty() && this->Internal->Chain.knowsSides;
}

vtkDoubleArray* vtkTransformReader::GetMatrix()
{
  State& state = *this->Internal;
  state.Rows->SetNumberOfValues(0);
  const std::optional<AffineLink> affine =
    this->Load().empty() ? affineOf(state.Chain) : std::nullopt;
  for (int row = 0; affine && row < 4; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      const double last = column == 3 ? 1.0 : 0.0;
      const double number = column == 3 ? affine->offset[row % 3] : affine->linear[column][row % 3];
      state.Rows->InsertNextValue(row == 3 ? last : number);
    }
  }
  return state.Rows;
}

vtkDoubleArray* vtkTransformReader::GetMappedPoints()
{
  return this->MapPoints(false, this->Internal->Mapped);
}

vtkDoubleArray* vtkTransformReader::GetMappedBackPoints()
{
  return this->MapPoints(true, this->Internal->MappedBack);
}

vtkDoubleArray* vtkTransformReader::MapPoints(bool isBack, vtkDoubleArray* to)
{
  const State& state = *this->Internal;
  const auto points = this->Load().empty() ? static_cast<vtkIdType>(state.Points.size()) : 0;
  to->SetNumberOfValues(4 * points);
  double* const numbers = to->GetPointer(0);
  parallelFor(0, points, MappedOfThread, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i < last; ++i)
    {
      double& missMm = numbers[4 * i + 3];
      missMm = 0.0;
      const glm::dvec3 point = isBack ? mappedBack(state.Chain, state.Points[i], &missMm)
                                      : mapped(state.Chain, state.Points[i], &missMm);
      for (int axis = 0; axis < 3; ++axis)
      {
        numbers[4 * i + axis] = point[axis];
      }
    }
  });
  return to;
}

vtkDoubleArray* vtkTransformReader::GetOwnBounds()
{
  State& state = *this->Internal;
  state.Bounds->SetNumberOfValues(0);
  const std::optional<Grid> grid = this->Load().empty() ? ownGridOf(state.Chain) : std::nullopt;
  if (!grid)
  {
    return state.Bounds;
  }
  glm::dvec3 low = grid->origin;
  glm::dvec3 high = grid->origin;
  for (int corner = 1; corner < 8; ++corner)
  {
    const glm::dvec3 side(corner & 1, corner >> 1 & 1, corner >> 2);
    const glm::dvec3 at = grid->worldFromGrid(side * glm::dvec3(grid->dimensions - 1));
    low = glm::min(low, at);
    high = glm::max(high, at);
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    state.Bounds->InsertNextValue(low[axis]);
    state.Bounds->InsertNextValue(high[axis]);
  }
  return state.Bounds;
}

std::string vtkTransformReader::GetStories()
{
  std::string lines;
  if (this->Load().empty())
  {
    for (const std::string& story : this->Internal->Chain.stories)
    {
      lines += (lines.empty() ? "" : "\n") + story;
    }
  }
  return lines;
}

int vtkTransformReader::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

int vtkTransformReader::RequestInformation(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  State& state = *this->Internal;
  state.Good = false;
  if (this->FileName.empty())
  {
    return 1; // Python sets properties one after the other, and ParaView asks after each
  }
  state.ProblemOfRun = sentenceThrownBy("Transform Reader", [&] {
    throwIfAny(this->Load());
    this->ChooseGrid(inputs[0]->GetInformationObject(0));
  });
  throwIfAny(state.ProblemOfRun);
  state.Good = true;
  announce(outputs->GetInformationObject(0), state.OutputGrid);
  return 1;
}

void vtkTransformReader::ChooseGrid(vtkInformation* volume)
{
  State& state = *this->Internal;
  if (volume)
  {
    const glm::ivec3 sides = glm::make_vec3(this->LatticeDimensions);
    requireLatticeSides(sides);
    state.OutputGrid = withDimensions(wholeGridOf(volume), sides);
  }
  else if (const std::optional<Grid> own = ownGridOf(state.Chain))
  {
    state.OutputGrid = *own;
  }
  else
  {
    throw Problem("Transform file " + this->FileName + " is " + kindOf(state.Chain) +
      " and has no points of its own: name the Volume to bend");
  }
  requirePosition(state.OutputGrid, "");
}

int vtkTransformReader::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  updateWholeExtent(inputs[0]->GetInformationObject(0)); // the output's would not fit it
  return 1;
}

int vtkTransformReader::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  State& state = *this->Internal;
  throwIfAny(this->FileName.empty() ? this->Load() : "");
  if (!state.Good)
  {
    return 0; // RequestInformation has reported why
  }
  vtkInformation* information = outputs->GetInformationObject(0);
  if (information->Get(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER()) > 0)
  {
    return 1; // the first piece has all points; others would repeat them on their MPI ranks
  }
  state.ProblemOfRun = sentenceThrownBy("Transform Reader", [&] {
    this->FillField(vtkImageData::GetData(information), inputs[0]->GetInformationObject(0));
  });
  throwIfAny(state.ProblemOfRun);
  return 1;
}

void vtkTransformReader::FillField(vtkImageData* field, vtkInformation* volume)
{
  const State& state = *this->Internal;
  const auto wanted = static_cast<brainshift::Direction>(this->OutputDirection);
  const DirectedTransform transform{ state.Chain,
    static_cast<brainshift::Direction>(this->Direction) };
  requireHostMemory("a field of " + sizeText(glm::dvec3(state.OutputGrid.dimensions)) + " points",
    2.0 * sizeof(glm::vec3) * static_cast<double>(state.OutputGrid.count()));
  Lattice lattice;
  lattice.grid = state.OutputGrid;
  lattice.kernel = this->Kernel;
  if (!sample(this, transform, wanted, lattice.grid, lattice.displacements))
  {
    return; // stopped
  }
  this->RequireNumbers(transform.direction == wanted, lattice);
  this->LargestError = 0.0;
  if (volume && this->OutputDirection == Forward)
  {
    interpolateAtPoints(lattice);
    this->LargestError = largestErrorOf(lattice, transform);
    setLattice(field, lattice);
  }
  else
  {
    setField(field, lattice.grid, lattice.displacements, wanted);
  }
  const WorldAxes world = this->World == LPS ? WorldAxes::LPS : WorldAxes::RAS;
  const WorldAxes axes = state.Chain.knowsSides ? world : WorldAxes::Unknown;
  nameWorldAxes(field, axes);
  const WorldAxes expected = volume ? worldAxesOf(vtkImageData::GetData(volume)) : axes;
  if (axes == WorldAxes::Unknown &&
    expected != axes) // Free-Form Deformation compares what is known
  {
    warn(this, wordsOnSides({ "the volume", expected }, { "the transform", axes }));
  }
}

void vtkTransformReader::RequireNumbers(bool isOwnDirection, Lattice& lattice)
{
  const std::string gap = gapIn(lattice.grid, lattice.displacements);
  if (gap.empty())
  {
    return;
  }
  const std::string has = "Transform file " + this->FileName + " has " + gap;
  throwIfAny(isOwnDirection ? has + "; all control points need one" : "");
  closeGap(lattice.displacements);
  warn(
    this, has + "; the tissue there stays, and beside it the deformation is not that of the file");
}

void vtkTransformReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n"
     << indent << "FixedImage: " << this->FixedImage << "\n"
     << indent << "MovingImage: " << this->MovingImage << "\n"
     << indent << "MatrixProgram: " << this->MatrixProgram << "\n"
     << indent << "FieldsBetween: " << (this->FieldsBetween == Held ? "Held" : "Linear") << "\n"
     << indent << "World: " << (this->World == RAS ? "RAS" : "LPS") << "\n"
     << indent << "Direction: " << (this->Direction == Forward ? "Forward" : "Backward") << "\n"
     << indent << "OutputDirection: " << (this->OutputDirection == Forward ? "Forward" : "Backward")
     << "\n"
     << indent << "Kernel: " << this->Kernel << "\n"
     << indent << "LargestError: " << this->LargestError << "\n";
}

// SPDX-License-Identifier: BSD-3-Clause
#include "vtkDeformGeometry.h"

#include "Common/Guard.h"
#include "Common/Portions.h"
#include "Filters/Attached/DeformableVolume.h"
#include "Filters/Attached/InputAxes.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkExtentTranslator.h"
#include "vtkIdList.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"

using namespace brainshift;

vtkStandardNewMacro(vtkDeformGeometry);
brainshiftGuardRequestsMacro(vtkDeformGeometry);

namespace
{
// Fractions of the progress bar.
constexpr double PointsDone = 0.5;
constexpr double PointNormalsDone = 0.8;

glm::dvec3 tupleOf(vtkDataArray* array, vtkIdType index)
{
  double tuple[3];
  array->GetTuple(index, tuple);
  return { tuple[0], tuple[1], tuple[2] };
}

// Room for as many vectors, as precise; in double precision where they were whole numbers.
vtkSmartPointer<vtkDataArray> likeArray(vtkDataArray* array)
{
  const int type = array->GetDataType() == VTK_FLOAT ? VTK_FLOAT : VTK_DOUBLE;
  auto like = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type));
  like->SetName(array->GetName());
  like->SetNumberOfComponents(3);
  like->SetNumberOfTuples(array->GetNumberOfTuples());
  return like;
}

glm::dvec3 middleOfCell(vtkPointSet* mesh, vtkIdType cell, vtkIdList* points)
{
  mesh->GetCellPoints(cell, points);
  glm::dvec3 sum(0.0);
  for (vtkIdType i = 0; i < points->GetNumberOfIds(); ++i)
  {
    sum += tupleOf(mesh->GetPoints()->GetData(), points->GetId(i));
  }
  return sum / static_cast<double>(points->GetNumberOfIds());
}

// Positions of the cells' middles: what the map's derivatives are taken at for normals of cells.
std::vector<glm::dvec3> middlesOfCells(vtkPointSet* mesh)
{
  std::vector<glm::dvec3> middles(mesh->GetNumberOfCells());
  vtkNew<vtkIdList> points;
  for (vtkIdType cell = 0; cell < mesh->GetNumberOfCells(); ++cell)
  {
    middles[cell] = middleOfCell(mesh, cell, points);
  }
  return middles;
}

// Each returns false if the user aborts.
bool movePoints(
  const ProgressOf& progress, const DirectedMap& map, vtkDataArray* from, vtkPointSet* output)
{
  const vtkSmartPointer<vtkDataArray> to = likeArray(from);
  vtkNew<vtkPoints> points;
  points->SetData(to);
  output->SetPoints(points);
  const auto move = [&](vtkIdType first, vtkIdType last) {
    for (vtkIdType point = first; point < last; ++point)
    {
      const glm::dvec3 position = map.position(tupleOf(from, point));
      to->SetTuple(point, &position.x);
    }
  };
  return forPortions(progress, from->GetNumberOfTuples(), MappedOfThread, move);
}

// `positionOf(i)`: of normal i, before the map.
template <typename Position>
bool turnNormals(const ProgressOf& progress, const DirectedMap& map, vtkDataSetAttributes* from,
  vtkDataSetAttributes* to, const Position& positionOf)
{
  vtkDataArray* normals = from->GetNormals();
  const vtkSmartPointer<vtkDataArray> turned = likeArray(normals);
  to->SetNormals(turned); // in place of the array of that name
  const auto turn = [&](vtkIdType first, vtkIdType last) {
    for (vtkIdType i = first; i < last; ++i)
    {
      const glm::dvec3 position = positionOf(i);
      const glm::dmat3 jacobian = map.jacobian(position, map.position(position));
      const glm::dvec3 normal = turnedNormal(jacobian, tupleOf(normals, i));
      turned->SetTuple(i, &normal.x);
    }
  };
  return forPortions(progress, normals->GetNumberOfTuples(), MappedOfThread, turn);
}

bool deform(vtkAlgorithm* filter, const DirectedMap& map, vtkPointSet* input, vtkPointSet* output)
{
  vtkDataArray* points = input->GetPoints()->GetData();
  bool going = movePoints({ filter, 0.0, PointsDone }, map, points, output);
  if (going && input->GetPointData()->GetNormals())
  {
    going = turnNormals({ filter, PointsDone, PointNormalsDone }, map, input->GetPointData(),
      output->GetPointData(), [&](vtkIdType point) { return tupleOf(points, point); });
  }
  if (going && input->GetCellData()->GetNormals())
  {
    const std::vector<glm::dvec3> middles = middlesOfCells(input);
    going = turnNormals({ filter, PointNormalsDone, 1.0 }, map, input->GetCellData(),
      output->GetCellData(), [&](vtkIdType cell) { return middles[cell]; });
  }
  return going;
}
}

vtkDeformGeometry::vtkDeformGeometry()
{
  this->SetNumberOfInputPorts(2);
}

void vtkDeformGeometry::SetDeformationConnection(vtkAlgorithmOutput* volume)
{
  this->SetInputConnection(1, volume);
}

int vtkDeformGeometry::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), port == 0 ? "vtkPointSet" : "vtkImageData");
  return 1;
}

int vtkDeformGeometry::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  // Any piece of the volume carries the lattice: take the one this process has anyway. An extent
  // of a structured mesh would mean nothing to it.
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  vtkInformation* volume = inputs[1]->GetInformationObject(0);
  vtkInformation* output = outputs->GetInformationObject(0);
  vtkNew<vtkExtentTranslator> pieces;
  pieces->SetWholeExtent(volume->Get(Pipeline::WHOLE_EXTENT()));
  pieces->SetPiece(output->Get(Pipeline::UPDATE_PIECE_NUMBER()));
  pieces->SetNumberOfPieces(std::max(1, output->Get(Pipeline::UPDATE_NUMBER_OF_PIECES())));
  pieces->PieceToExtent();
  volume->Set(Pipeline::UPDATE_EXTENT(), pieces->GetExtent(), 6);
  return this->Superclass::RequestUpdateExtent(request, inputs, outputs);
}

int vtkDeformGeometry::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPointSet* input = vtkPointSet::GetData(inputs[0]);
  vtkPointSet* output = vtkPointSet::GetData(outputs);
  const DirectedMap map = directedMapOf(
    vtkDataObject::GetData(inputs[1]), static_cast<brainshift::Direction>(this->Direction));
  warnAnew(this,
    wordsOnSidesOf(namedAxesOfInput("the geometry", this, 0), vtkDataObject::GetData(inputs[1])),
    this->Warned);
  output->ShallowCopy(input);
  if (input->GetPoints() && !deform(this, map, input, output))
  {
    output->Initialize();
  }
  return 1;
}

void vtkDeformGeometry::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Direction: " << (this->Direction == Forward ? "Forward" : "Backward") << "\n";
}

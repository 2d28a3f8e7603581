// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTransformPoints.h"

#include "Common/Guard.h"
#include "Common/Numbers.h"
#include "Common/Portions.h"
#include "Common/Problem.h"
#include "Filters/Attached/DeformableVolume.h"
#include "Formats/Files/Text.h"
#include "Formats/Transforms/PointTransform.h"
#include "vtkTransformReader.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <vector>

using namespace brainshift;

vtkStandardNewMacro(vtkTransformPoints);
brainshiftGuardRequestsMacro(vtkTransformPoints);

namespace
{
constexpr double StepMm = 0.1; // between the points that a derivative is taken from

// `missesMm`: of each point.
void warnOfMisses(vtkObject* filter, const std::vector<double>& missesMm)
{
  const auto missed = std::count_if(
    missesMm.begin(), missesMm.end(), [](double missMm) { return missMm > ToldMissMm; });
  if (missed > 0)
  {
    const double most = *std::max_element(missesMm.begin(), missesMm.end());
    warn(filter,
      joined(missed, " of ", missesMm.size(), " points miss their positions by up to ",
        roundedText(most), " mm: the transform folds or jumps there"));
  }
}

glm::dvec3 tupleOf(vtkDataArray* array, vtkIdType index)
{
  double tuple[3];
  array->GetTuple(index, tuple);
  return { tuple[0], tuple[1], tuple[2] };
}

// The derivatives of a map at a point, from differences.
template <typename Map>
glm::dmat3 jacobianOf(const Map& map, const glm::dvec3& from)
{
  glm::dmat3 jacobian;
  for (int axis = 0; axis < 3; ++axis)
  {
    glm::dvec3 step(0.0);
    step[axis] = StepMm / 2.0;
    jacobian[axis] = (map(from + step) - map(from - step)) / StepMm;
  }
  return jacobian;
}
}

vtkTransformPoints::vtkTransformPoints() = default;
vtkTransformPoints::~vtkTransformPoints() = default;

void vtkTransformPoints::SetTransform(vtkTransformReader* transform)
{
  if (transform != this->Transform)
  {
    this->Transform = transform;
    this->Modified();
  }
}

vtkMTimeType vtkTransformPoints::GetMTime()
{
  const vtkMTimeType own = this->Superclass::GetMTime();
  return this->Transform ? std::max(own, this->Transform->GetMTime()) : own;
}

int vtkTransformPoints::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* input = vtkPolyData::GetData(inputs[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputs);
  throwIfAny(
    this->Transform ? this->Transform->GetProblem() : "Transform is not set; it must read a file");
  output->ShallowCopy(input);
  const vtkIdType count = input->GetNumberOfPoints();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(count);
  const PointTransform& chain = this->Transform->GetChain();
  const auto moved = [&](const glm::dvec3& from, double* missMm = nullptr) {
    return this->Direction == Forward ? mapped(chain, from, missMm)
                                      : mappedBack(chain, from, missMm);
  };
  std::vector<double> missesMm(static_cast<std::size_t>(count), 0.0);
  vtkDataArray* normals = input->GetPointData()->GetNormals();
  vtkNew<vtkDoubleArray> turned;
  turned->SetNumberOfComponents(3);
  turned->SetNumberOfTuples(normals ? count : 0);
  const auto move = [&](vtkIdType first, vtkIdType last) {
    for (vtkIdType i = first; i < last; ++i)
    {
      glm::dvec3 from;
      input->GetPoint(i, &from.x);
      const glm::dvec3 to = moved(from, &missesMm[static_cast<std::size_t>(i)]);
      points->SetPoint(i, &to.x);
      if (normals)
      {
        const glm::dvec3 normal = turnedNormal(jacobianOf(moved, from), tupleOf(normals, i));
        turned->SetTuple(i, &normal.x);
      }
    }
  };
  if (!forPortions({ this }, count, MappedOfThread, move))
  {
    output->Initialize();
  }
  else if (count > 0)
  {
    output->SetPoints(points);
    if (normals)
    {
      turned->SetName(normals->GetName());
      output->GetPointData()->SetNormals(turned);
    }
    output->GetCellData()->SetNormals(nullptr); // those of the flat cells are made from the points
  }
  warnOfMisses(this, missesMm);
  return 1;
}

void vtkTransformPoints::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Transform: " << this->Transform.Get() << "\n"
     << indent << "Direction: " << (this->Direction == Forward ? "Forward" : "Backward") << "\n";
}

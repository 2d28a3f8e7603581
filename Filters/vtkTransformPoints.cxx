// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTransformPoints.h"

#include "Common/Guard.h"
#include "Common/Portions.h"
#include "Common/Problem.h"
#include "Formats/Transforms/PointTransform.h"
#include "vtkTransformReader.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

using namespace brainshift;

vtkStandardNewMacro(vtkTransformPoints);
brainshiftGuardRequestsMacro(vtkTransformPoints);

namespace
{
constexpr vtkIdType PointsAtLeast = 256; // for a thread: about 0.1 ms
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
  const auto move = [&](vtkIdType first, vtkIdType last) {
    for (vtkIdType i = first; i < last; ++i)
    {
      glm::dvec3 from;
      input->GetPoint(i, &from.x);
      const glm::dvec3 to =
        this->Direction == Forward ? mapped(chain, from) : mappedBack(chain, from);
      points->SetPoint(i, &to.x);
    }
  };
  if (!forPortions({ this }, count, PointsAtLeast, move))
  {
    output->Initialize();
  }
  else if (count > 0)
  {
    output->SetPoints(points);
  }
  return 1;
}

void vtkTransformPoints::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Transform: " << this->Transform.Get() << "\n"
     << indent << "Direction: " << (this->Direction == Forward ? "Forward" : "Backward") << "\n";
}

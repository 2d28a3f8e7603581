// SPDX-License-Identifier: BSD-3-Clause
#include "Common/PiecedArray.h"

#include "Common/Parallel.h"

#include "vtkNew.h"

#include <memory>

namespace brainshift
{
namespace
{
constexpr vtkIdType TuplesAtLeast = 65536; // for a thread

template <typename T>
vtkSmartPointer<vtkDataArray> piecedArray(
  const Extent& extent, const std::vector<ArrayPiece>& pieces)
{
  vtkNew<vtkImplicitArray<Pieces<T>>> array;
  array->SetBackend(std::make_shared<Pieces<T>>(extent, pieces));
  array->SetName(pieces.front().values->GetName());
  array->SetNumberOfComponents(pieces.front().values->GetNumberOfComponents());
  array->SetNumberOfTuples(static_cast<vtkIdType>(pointsIn(extent)));
  return array;
}

template <typename T>
void copyRuns(vtkDataArray* from, vtkDataArray* to)
{
  if (!asPieced<T>(from))
  {
    to->DeepCopy(from);
    return;
  }
  T* const values = static_cast<T*>(to->GetVoidPointer(0));
  const vtkIdType components = from->GetNumberOfComponents();
  parallelFor(0, from->GetNumberOfTuples(), TuplesAtLeast, [&](vtkIdType begin, vtkIdType end) {
    forEachRun<T>(from, begin, end, [&](vtkIdType first, const T* run, vtkIdType count) {
      std::copy_n(run, count * components, values + first * components);
    });
  });
}
}

vtkSmartPointer<vtkDataArray> arrayOfPieces(const Extent& extent, std::vector<ArrayPiece> pieces)
{
  for (ArrayPiece& piece : pieces)
  {
    piece.values = contiguous(piece.values);
  }
  if (pieces.size() == 1 && pieces.front().layout == extent)
  {
    return pieces.front().values;
  }
  vtkSmartPointer<vtkDataArray> array;
  switch (pieces.front().values->GetDataType())
  {
    vtkTemplateMacro(array = piecedArray<VTK_TT>(extent, pieces));
  }
  return array;
}

vtkSmartPointer<vtkDataArray> contiguous(vtkDataArray* array)
{
  if (array->HasStandardMemoryLayout())
  {
    return array;
  }
  const auto copy = vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(array->GetDataType()));
  copy->SetName(array->GetName());
  copy->SetNumberOfComponents(array->GetNumberOfComponents());
  copy->SetNumberOfTuples(array->GetNumberOfTuples());
  switch (array->GetDataType())
  {
    vtkTemplateMacro(copyRuns<VTK_TT>(array, copy));
  }
  return copy;
}
}

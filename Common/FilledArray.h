// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Numbers as the array that a server sends to a client.
#ifndef BrainShift_FilledArray_h
#define BrainShift_FilledArray_h

#include "vtkDoubleArray.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <vector>

namespace brainshift
{
/** The array, with these values instead of its own. */
inline vtkDoubleArray* filled(vtkDoubleArray* array, const std::vector<double>& values)
{
  array->SetNumberOfValues(static_cast<vtkIdType>(values.size()));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  return array;
}

/** Adds the three numbers of a vector at the end of an array. */
inline void append(vtkDoubleArray* array, const glm::dvec3& vector)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    array->InsertNextValue(vector[axis]);
  }
}
}

#endif

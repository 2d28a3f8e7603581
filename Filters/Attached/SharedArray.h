// SPDX-License-Identifier: BSD-3-Clause
// A second array object over the same numbers, which keeps their range.
//
// ParaView asks a filter's output for the range of every array after each execution, and VTK keeps
// the answer with the data set and not with the array: a filter that passes 10 million voxels
// through pays for reading them, twice, at every stroke (0.2 s). These arrays answer from the
// range that the source array keeps.
#ifndef BrainShift_SharedArray_h
#define BrainShift_SharedArray_h

#include "vtkDataArray.h" // for its smart pointer
#include "vtkSmartPointer.h"

#include <vector>

class vtkDataSetAttributes;

namespace brainshift
{
// The same numbers under another name, for data that travels beside a volume.
vtkSmartPointer<vtkDataArray> sharedAs(const char* name, vtkDataArray* source);

class SharedArrays
{
public:
  SharedArrays();
  ~SharedArrays();

  // Replaces the numeric arrays of `attributes` by arrays over the same numbers, the same ones as
  // last time for an array that did not change. Attributes (scalars, vectors, ...) stay as they
  // were. Arrays of an unusual memory layout stay themselves.
  void share(vtkDataSetAttributes* attributes);

private:
  struct Entry
  {
    vtkSmartPointer<vtkDataArray> source;
    unsigned long long time;
    vtkSmartPointer<vtkDataArray> shared;
  };
  std::vector<Entry> Entries; // of the last share
};
}

#endif

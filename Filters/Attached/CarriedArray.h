// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Arrays of data that travels beside a volume: a second array object over the same numbers, which
/// keeps their range, and a grid.
///
/// ParaView asks a filter's output for the range of every array after each execution. VTK keeps the
/// answer with the data set and not with the array. So a filter that passes 10 million voxels
/// through reads them twice at every stroke, which costs 0.2 s. These arrays answer from the range
/// that the source array keeps.
#ifndef BrainShift_CarriedArray_h
#define BrainShift_CarriedArray_h

#include "Common/Grid.h"

#include "vtkDataArray.h" // for its smart pointer
#include "vtkSmartPointer.h"

#include <vector>

class vtkDataSetAttributes;
class vtkFieldData;

namespace brainshift
{
/** An array over the same numbers with another name, for data that travels beside a volume. */
vtkSmartPointer<vtkDataArray> sharedAs(const char* name, vtkDataArray* source);

/** Shares one array under another name: the same object as long as the source stays as it is. */
class RenamedArray
{
public:
  /** `source` under the name; null for null. */
  vtkDataArray* as(const char* name, vtkDataArray* source);

private:
  vtkSmartPointer<vtkDataArray> Source; // of Shared, as of Time
  unsigned long long Time = 0;
  vtkSmartPointer<vtkDataArray> Shared;
};

/** Shares all arrays of a data set, time after time. */
class SharedArrays
{
public:
  SharedArrays();
  ~SharedArrays();

  /**
   * Replaces the numeric arrays of `attributes` by arrays over the same numbers. An array that did
   * not change since the last call gets the object that it got then. Attributes (scalars, vectors,
   * ...) stay as they were. Arrays with an unusual memory layout are not replaced.
   */
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

/**
 * Attaches a grid under a name: an array with one tuple of 18 doubles, nx ny nz, world position of
 * the first point (mm), spacing (mm), direction matrix (row by row, as vtkImageData holds it).
 */
void attachGrid(vtkFieldData* fields, const char* name, const Grid& grid);

/** Reads the grid that was attached under a name. False if there is no such array. */
bool readGrid(vtkFieldData* fields, const char* name, Grid& grid);
}

#endif

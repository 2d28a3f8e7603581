// SPDX-License-Identifier: BSD-3-Clause
// A grid as a field array, for images that travel with a data object: double x 18, which are nx ny
// nz, world position of the first point (mm), spacing (mm), direction matrix (row by row, as
// vtkImageData holds it).
#ifndef BrainShift_GridArray_h
#define BrainShift_GridArray_h

#include "Filters/Deformation/Grid.h"

class vtkFieldData;

namespace brainshift
{
void attachGrid(vtkFieldData* fields, const char* name, const Grid& grid);

// False if there is no such array.
bool readGrid(vtkFieldData* fields, const char* name, Grid& grid);
}

#endif

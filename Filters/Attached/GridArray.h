// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief A grid as a field array, for images that travel with a data set.
 *
 * The array has one tuple of 18 doubles: nx ny nz, world position of the first point (mm), spacing
 * (mm), direction matrix (row by row, as vtkImageData holds it).
 */
#ifndef BrainShift_GridArray_h
#define BrainShift_GridArray_h

#include "Common/Grid.h"

class vtkFieldData;

namespace brainshift
{
/** Attaches the grid under a name. */
void attachGrid(vtkFieldData* fields, const char* name, const Grid& grid);

/** Reads the grid that was attached under a name. False if there is no such array. */
bool readGrid(vtkFieldData* fields, const char* name, Grid& grid);
}

#endif

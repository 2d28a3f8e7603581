// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A grid that travels beside a volume, as a field array.
#ifndef BrainShift_CarriedGrid_h
#define BrainShift_CarriedGrid_h

#include "Common/Grid.h"

class vtkFieldData;

namespace brainshift
{
/**
 * Attaches a grid under a name: an array with one tuple of 18 doubles, nx ny nz, world position of
 * the first point (mm), spacing (mm), direction matrix (row by row, as vtkImageData holds it).
 */
void attachGrid(vtkFieldData* fields, const char* name, const Grid& grid);

/** Reads the grid that was attached under a name. False if there is no such array. */
bool readGrid(vtkFieldData* fields, const char* name, Grid& grid);
}

#endif

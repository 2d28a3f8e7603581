// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Surfaces and streamlines as data of VTK, with their numbers as arrays, and the field array
/// WorldAxes if the file says where they lie.
#ifndef BrainShift_SurfaceData_h
#define BrainShift_SurfaceData_h

#include "Formats/Surfaces/SurfaceFile.h"

class vtkPolyData;

namespace brainshift
{
/** Triangles with double precision points and point arrays. */
void setSurface(vtkPolyData* data, const Surface& surface);

/** Lines with single precision points, and arrays of points and lines. */
void setTracts(vtkPolyData* data, const Tracts& tracts);

/**
 * The lines of data in RAS, with their arrays; data in LPS is turned, and data of unknown axes
 * gives a note. Throws the end of a sentence if there are other cells than lines.
 */
Tracts tractsOf(vtkPolyData* data);
}

#endif

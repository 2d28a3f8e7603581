// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What an input of a filter says of its axes, models of 3D Slicer included.
#ifndef BrainShift_InputAxes_h
#define BrainShift_InputAxes_h

#include "Common/WorldAxes.h"
#include "vtkBrainShiftFiltersModule.h" // for the export macro

class vtkAlgorithm;

namespace brainshift
{
/**
 * As namedAxesOf for the data on a port, none included. If they say nothing, the file of their
 * reader may: 3D Slicer writes SPACE=LPS or SPACE=RAS into a comment of a .vtk, .ply, .stl or .obj,
 * which ParaView's readers drop. The file counts through filters with one input, as long as the
 * points lie within the box of what was read: beyond it, they were turned around or moved.
 */
VTKBRAINSHIFTFILTERS_EXPORT NamedAxes namedAxesOfInput(
  const std::string& noun, vtkAlgorithm* filter, int port);
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Landmarks as points of VTK: vertices with the point arrays Label, Number, Time and Deviation,
/// each only where a point has one, and the field array WorldAxes.
#ifndef BrainShift_LandmarkPoints_h
#define BrainShift_LandmarkPoints_h

#include "Formats/Landmarks/LandmarkFile.h"

class vtkPointSet;
class vtkPolyData;

namespace brainshift
{
/** Makes a list a mesh of vertices, mm, RAS. */
void setLandmarks(vtkPolyData* points, const LandmarkList& list);

/** The points of a mesh and their arrays of these names. Axes that it does not name are RAS. */
LandmarkList landmarksOf(vtkPointSet* points);
}

#endif

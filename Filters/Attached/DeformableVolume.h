// SPDX-License-Identifier: BSD-3-Clause
// The contract between the Free-Form Deformation filter and everything that draws, bakes or
// exports: a deformable volume is a vtkImageData as it was, with these field-data arrays.
//
//   FFDDisplacements  float32 x 3, nx*ny*nz tuples, x fastest: displacement of each control point
//                     (mm, world axes, before Strength). Zero means stays.
//   FFDDimensions     int x 3: nx ny nz, 4 to 257 each
//   FFDBox            double x 15: world position of the first control point (mm), spacing (mm),
//                     direction matrix (row by row, as vtkImageData holds it)
//   FFDKernel         int: 0 Catmull-Rom, 1 B-spline
//   FFDSamples        int: nodes of the refined field between two control points, 0 to 16
//   FFDInverse        int: 0 exact, 1 negated
//   FFDStrength       double, 0 to 1: factor on all displacements
//   FFDMaskWeights    float32, only with a mask: share of the displacement, 0 to 1, that holds at
//                     each node of the refined field, (points - 1) * (FFDSamples + 1) + 1 a side, x
//                     fastest; what is drawn is trilinear between the nodes
#ifndef BrainShift_DeformableVolume_h
#define BrainShift_DeformableVolume_h

#include "Filters/Deformation/Lattice.h"
#include "Filters/Deformation/PointMap.h"
#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include <string>

class vtkDataObject;
class vtkImageData;

namespace brainshift
{
struct Deformation
{
  Lattice lattice;
  int samples = 4;
  Inverse inverse = Inverse::Exact;
  double strength = 1.0;
};

// Geometry of an image's points.
VTKBRAINSHIFTFILTERS_EXPORT Grid gridOf(vtkImageData* image);

VTKBRAINSHIFTFILTERS_EXPORT void attach(vtkDataObject* volume, const Deformation& deformation);

// True if the data carries a deformation, well formed or not.
VTKBRAINSHIFTFILTERS_EXPORT bool carriesDeformation(vtkDataObject* volume);

// Reads what attach wrote. False, with one sentence in `error`, if an array is missing or wrong.
VTKBRAINSHIFTFILTERS_EXPORT bool readDeformation(
  vtkDataObject* volume, Deformation& deformation, std::string& error);

// The lattice with Strength applied: what is drawn.
VTKBRAINSHIFTFILTERS_EXPORT Lattice effectiveLattice(const Deformation& deformation);

// Latest change of the attached arrays; 0 if there are none.
VTKBRAINSHIFTFILTERS_EXPORT unsigned long long deformationTime(vtkDataObject* volume);
}

#endif

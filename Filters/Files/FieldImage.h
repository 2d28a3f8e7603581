// SPDX-License-Identifier: BSD-3-Clause
// Displacement fields as images: what files, inversion and lattices hand to the pipeline.
#ifndef BrainShift_FieldImage_h
#define BrainShift_FieldImage_h

#include "Filters/Attached/FieldDirection.h"
#include "Filters/Deformation/Grid.h"
#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include <glm/vec3.hpp>

#include <vector>

class vtkDataArray;
class vtkImageData;
class vtkInformation;

namespace brainshift
{
constexpr const char* DisplacementName = "Displacement";

// The whole of a grid, told before the data is there.
VTKBRAINSHIFTFILTERS_EXPORT void announce(vtkInformation* output, const Grid& grid);

// Makes `image` lie on `grid`, whole, with the point array Displacement (float32 x 3, mm, world
// axes) as its vectors, and names the direction.
VTKBRAINSHIFTFILTERS_EXPORT void setField(vtkImageData* image, const Grid& grid,
  const std::vector<glm::vec3>& displacements, Direction direction);

// The displacements of an image: Displacement, its vectors, or the first point array of three
// components; null if there is none.
VTKBRAINSHIFTFILTERS_EXPORT vtkDataArray* fieldOf(vtkImageData* image);

VTKBRAINSHIFTFILTERS_EXPORT std::vector<glm::vec3> vectorsOf(vtkDataArray* array);
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Displacement fields as images: what readers, inversion and lattices hand to the pipeline.
#ifndef BrainShift_FieldImage_h
#define BrainShift_FieldImage_h

#include "Common/FieldDirection.h"
#include "Common/ImageGrid.h"
#include "vtkBrainShiftFormatsModule.h" // for the export macro

#include <vector>

class vtkDataArray;
class vtkDataObject;
class vtkImageData;

namespace brainshift
{
/** Name of the point array of displacements. */
constexpr const char* DisplacementName = "Displacement";

/**
 * Name of the point array that says how far a place can be believed: float32, mm, one standard
 * deviation along an axis; infinity where nothing was measured.
 */
constexpr const char* DeviationName = "Deviation";

/**
 * Removes all field arrays but the world axes. The pipeline passes on those of the volume that a
 * field is made for, and labels, unit or reference of a volume are none of a field.
 */
VTKBRAINSHIFTFORMATS_EXPORT void forgetVolume(vtkDataObject* field);

/**
 * Makes an image of a field: it lies on the whole grid and has the point array Displacement
 * (float32 x 3, mm, world axes) as its vectors and a field array that names the direction. Of the
 * field arrays of before only the world axes stay.
 */
VTKBRAINSHIFTFORMATS_EXPORT void setField(vtkImageData* image, const Grid& grid,
  const std::vector<glm::vec3>& displacements, Direction direction);

/**
 * The displacements of an image: its point array Displacement, else its vectors, else its first
 * point array of three components; null if there is none.
 */
VTKBRAINSHIFTFORMATS_EXPORT vtkDataArray* fieldOf(vtkImageData* image);

/** Whether an image says that it is a field: by a direction, or a point array Displacement. */
VTKBRAINSHIFTFORMATS_EXPORT bool saysField(vtkImageData* image);

/**
 * Whether an image is meant as a field: it says so, or has no scalars other than three floating
 * numbers, which a reader of volumes did not name Intensity. Otherwise its vectors stand beside
 * what it is.
 */
VTKBRAINSHIFTFORMATS_EXPORT bool isFieldImage(vtkImageData* image);

/** The tuples of an array of three components. */
VTKBRAINSHIFTFORMATS_EXPORT std::vector<glm::vec3> vectorsOf(vtkDataArray* array);
}

#endif

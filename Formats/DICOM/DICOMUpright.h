// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Interpolates uneven or tilted slices on an upright grid.
 */
#ifndef BrainShift_DICOMUpright_h
#define BrainShift_DICOMUpright_h

#include "Formats/DICOM/DICOMStack.h"

class vtkImageData;

namespace brainshift
{
/**
 * Fills `grid` from `images`, one slice for each image: linear between columns, rows and slices.
 * Whole numbers are rounded. Where no image lies, the grid has the least number of all images.
 *
 * @param grid   allocated, with the size that `resampling` has and the type of the images
 */
void makeUpright(const DICOMResampling& resampling, vtkImageData* images, vtkImageData* grid);
}

#endif

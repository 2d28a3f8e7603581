// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Asks the pipeline for all of an image, for filters that read it everywhere.
 */
#ifndef BrainShift_WholeExtent_h
#define BrainShift_WholeExtent_h

class vtkInformation;

namespace brainshift
{
/**
 * Makes the update extent of an image its whole extent. Call it in RequestUpdateExtent.
 *
 * @param image   pipeline information of an input or output; null, for an optional input that is
 *                not connected, does nothing
 */
void updateWholeExtent(vtkInformation* image);
}

#endif

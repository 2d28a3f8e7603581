// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Asks the pipeline for all of an image, for filters that read it everywhere, and knows the
 *        rank that speaks for all.
 */
#ifndef BrainShift_WholeExtent_h
#define BrainShift_WholeExtent_h

#include "Filters/Deformation/Grid.h"

#include <string>

class vtkImageData;
class vtkInformation;

namespace brainshift
{
/**
 * Asks for all of an image, in one piece. Call it in RequestUpdateExtent. On several MPI ranks,
 * each rank then gets all of it. An extent alone would not do: a reader still splits the extent
 * into the pieces of the ranks.
 *
 * @param image   pipeline information of an input; null, for an optional input that is not
 *                connected, does nothing
 */
void updateWholeExtent(vtkInformation* image);

/// The grid of all of an image (mm, world), as the pipeline knows it before there is data.
Grid wholeGridOf(vtkInformation* information);

/// The grid of all of an image of which this process may have a piece.
Grid wholeGridOf(vtkImageData* piece, vtkInformation* information);

/**
 * What an image lacks of its whole extent: a sentence without its end, or empty if it is whole. A
 * source that knows no pieces may deliver less than it was asked for.
 *
 * @param image         the data
 * @param information   pipeline information of that input
 */
std::string problemOfPart(vtkImageData* image, vtkInformation* information);

/// Whether this process is the first of several MPI ranks, or the only one.
bool isFirstRank();
}

#endif

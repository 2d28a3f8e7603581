// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The grid of an image, whole or in pieces: its limits, and how a filter asks the pipeline for all
/// of it.
#ifndef BrainShift_ImageGrid_h
#define BrainShift_ImageGrid_h

#include "Common/Grid.h"
#include "Common/Problem.h"
#include "vtkBrainShiftCommonModule.h" // for the export macro

class vtkImageData;
class vtkInformation;

namespace brainshift
{
///@{
/** Limits of the spacing (mm) between neighbours of a grid: floats hold their squares. */
constexpr double ShortestSpacing = 1e-9;
constexpr double LongestSpacing = 1e9;
///@}

/**
 * So far may the products of a grid's axes be from those of a rotation or a mirror: its inverse is
 * taken to be its transpose, which then misses by at most 0.02 mm in 200 mm. Axes with five
 * decimals are near enough.
 */
constexpr double MostMissOfRotation = 1e-4;

/** The grid of an image's points, in world space. */
VTKBRAINSHIFTCOMMON_EXPORT Grid gridOf(vtkImageData* image);

/**
 * The grid of the points of an extent, which may be another than that of the image: the same, bit
 * for bit, whichever part the image has.
 */
VTKBRAINSHIFTCOMMON_EXPORT Grid gridOf(vtkImageData* image, const int extent[6]);

/**
 * What is wrong with the position of a grid, as the end of a sentence about it, without a full
 * stop: its spacing must be from ShortestSpacing to LongestSpacing, its origin at most
 * FarthestOriginSpacings away from 0, its other numbers finite, its axes perpendicular and 1 long
 * (MostMissOfRotation). It is empty if nothing is wrong.
 */
VTKBRAINSHIFTCOMMON_EXPORT std::string problemOfGrid(const Grid& grid);

/**
 * Throws a Problem if problemOfGrid finds something.
 *
 * @param beginning   of the sentence, such as "The volume's "
 */
VTKBRAINSHIFTCOMMON_EXPORT void requirePosition(const Grid& grid, const std::string& beginning);

/**
 * Announces to the pipeline that an output is on all of a grid. Call it in RequestInformation.
 */
VTKBRAINSHIFTCOMMON_EXPORT void announce(vtkInformation* output, const Grid& grid);

/**
 * Asks for all of an image, in one piece. Call it in RequestUpdateExtent. On several MPI ranks,
 * each rank then gets all of it. An extent alone would not do: a reader still splits the extent
 * into the pieces of the ranks.
 *
 * @param image   pipeline information of an input; null, for an optional input that is not
 *                connected, does nothing
 */
VTKBRAINSHIFTCOMMON_EXPORT void updateWholeExtent(vtkInformation* image);

/// The grid of all of an image (mm, world), as the pipeline knows it before there is data.
VTKBRAINSHIFTCOMMON_EXPORT Grid wholeGridOf(vtkInformation* information);

/// The grid of all of an image of which this process may have a piece.
VTKBRAINSHIFTCOMMON_EXPORT Grid wholeGridOf(vtkImageData* piece, vtkInformation* information);

/**
 * What an image lacks of its whole extent: a sentence without its end, or empty if it is whole. A
 * source that knows no pieces may deliver less than it was asked for.
 *
 * @param image         the data
 * @param information   pipeline information of that input
 */
VTKBRAINSHIFTCOMMON_EXPORT std::string problemOfPart(
  vtkImageData* image, vtkInformation* information);

/** Throws problemOfPart, unless the image is whole. */
VTKBRAINSHIFTCOMMON_EXPORT void requireWhole(vtkImageData* image, vtkInformation* information);

/// Whether this process is the first of several MPI ranks, or the only one.
VTKBRAINSHIFTCOMMON_EXPORT bool isFirstRank();
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Parts of an image that may be larger than memory: which part a filter is asked for, and how it
/// asks its input for one part after the other.
#ifndef BrainShift_ImageParts_h
#define BrainShift_ImageParts_h

#include "Common/Extent.h"
#include "vtkBrainShiftCommonModule.h" // for the export macro

#include <functional>
#include <vector>

class vtkImageData;
class vtkInformation;

namespace brainshift
{
/** The extent of an image. */
VTKBRAINSHIFTCOMMON_EXPORT Extent extentOf(vtkImageData* image);

/** The whole extent that the pipeline knows. */
VTKBRAINSHIFTCOMMON_EXPORT Extent wholeExtentOf(vtkInformation* image);

/** The extent that is asked for. In RequestData, it is that of a rank's piece. */
VTKBRAINSHIFTCOMMON_EXPORT Extent updateExtentOf(vtkInformation* image);

/**
 * What updateExtentOf will be in RequestData, as RequestUpdateExtent knows it. The filter is one
 * that can produce sub-extents.
 */
VTKBRAINSHIFTCOMMON_EXPORT Extent pieceAskedOf(vtkInformation* output);

/** Whether a filter is asked for one of several pieces, as on MPI ranks. */
VTKBRAINSHIFTCOMMON_EXPORT bool isOnePieceOfSeveral(vtkInformation* output);

/**
 * Cuts an extent into parts that fit, and together are all of it: each time across the longest
 * side. A part of `LeastSide` points a side or less is not cut.
 *
 * @param fits   whether a part is small enough
 */
VTKBRAINSHIFTCOMMON_EXPORT std::vector<Extent> cutToFit(
  const Extent& extent, const std::function<bool(const Extent&)>& fits);

constexpr int LeastSide = 24; ///< points

/**
 * An extent, and one more point along each axis where the whole goes on: with the cells between.
 */
VTKBRAINSHIFTCOMMON_EXPORT Extent withNextPoints(const Extent& extent, const Extent& whole);

/**
 * Bytes of the active scalars of a point, as the pipeline knows them before there is data; 8 where
 * it knows nothing.
 */
VTKBRAINSHIFTCOMMON_EXPORT double bytesOfPoint(vtkInformation* image);

/** Bytes of all numeric arrays for each point of an image, those of cells included. */
VTKBRAINSHIFTCOMMON_EXPORT double bytesOfPoint(vtkImageData* image);

/** The first points of an extent, two a side: enough to get field data. */
VTKBRAINSHIFTCOMMON_EXPORT Extent cornerOf(const Extent& extent);

/** Announces that a reader reads all of its file for any part. Filters pass this on. */
VTKBRAINSHIFTCOMMON_EXPORT void announceReadingAll(vtkInformation* output, bool readsAll);

/**
 * Whether a filter had better ask for all of an image, whichever part it needs: if it takes up to
 * so many MiB, or if its reader reads all of its file for any part.
 */
VTKBRAINSHIFTCOMMON_EXPORT bool isBestAskedWhole(vtkInformation* image, double limitMiB);

/** Asks for an extent of an image, in one piece. Call it in RequestUpdateExtent. */
VTKBRAINSHIFTCOMMON_EXPORT void updateExtent(vtkInformation* image, const Extent& extent);

/** Throws a Problem if an input has not all of the part that it was asked for. */
VTKBRAINSHIFTCOMMON_EXPORT void requirePart(vtkImageData* input, const Extent& part);

/**
 * Brings another part of an input, in RequestData: the data object of the input has it then, and
 * not what it had before. Throws a Problem if the part does not come.
 *
 * @param input   pipeline information of the input
 */
VTKBRAINSHIFTCOMMON_EXPORT void bringPart(vtkInformation* input, const Extent& part);
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Boxes of an image's points, or of its cells. Without VTK.
#ifndef BrainShift_Extent_h
#define BrainShift_Extent_h

#include "vtkBrainShiftCommonModule.h" // for the export macro

#include <array>

namespace brainshift
{
/// First and last along x, y and z, as VTK counts them.
using Extent = std::array<int, 6>;

/** Whether an extent holds all of another. */
VTKBRAINSHIFTCOMMON_EXPORT bool holds(const Extent& extent, const Extent& other);

/** The smallest extent that holds two, of which neither is empty. */
VTKBRAINSHIFTCOMMON_EXPORT Extent around(const Extent& a, const Extent& b);

/** What two extents have in common; it may be empty. */
VTKBRAINSHIFTCOMMON_EXPORT Extent common(const Extent& a, const Extent& b);

/** Whether an extent has nothing in it. */
VTKBRAINSHIFTCOMMON_EXPORT bool isEmpty(const Extent& extent);

/** The points in an extent; 0 if it is empty. */
VTKBRAINSHIFTCOMMON_EXPORT double pointsIn(const Extent& extent);
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Where a reconstructed ultrasound volume shows something.
 *
 * A probe sweeps over a part of the volume's box. The rest of the box has the lowest value of all,
 * and the border between both is no tissue.
 */
#ifndef BrainShift_Sweep_h
#define BrainShift_Sweep_h

#include "Common/Export.h"
#include "Common/Grid.h"
#include "Filters/Deformation/MaskWeights.h"
#include "Filters/Register/Volume.h"

namespace brainshift
{
/**
 * What the sweep saw, on voxels of about 1 mm. What it did not see is connected to the border of
 * the volume through voxels that have the lowest value. Dark tissue within the sweep counts as
 * seen. A volume that has no such border was seen as a whole.
 */
BRAINSHIFT_DEFORMATION_EXPORT Mask sweptRegion(const Volume& ultrasound);

/**
 * The part of a grid within `marginMm` of a region, with two points or more along each axis. All of
 * the grid where they lie apart.
 */
BRAINSHIFT_DEFORMATION_EXPORT Grid croppedTo(const Grid& grid, const Mask& region, double marginMm);
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
// Which strokes are too fine for a lattice.
#ifndef BrainShift_StrokeDensity_h
#define BrainShift_StrokeDensity_h

#include "Filters/Deformation/Grid.h"
#include "Filters/Deformation/Stroke.h"
#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include <string>
#include <vector>

namespace brainshift
{
// One sentence, without its full stop, on the enabled strokes whose radius is below the lattice's
// spacing: few or no control points lie within it, and the anchor moves by a third of the vector or
// less (Catmull-Rom, sigma 0.5). It names number, radius and spacing. Empty if there are none.
VTKBRAINSHIFTFILTERS_EXPORT std::string strokesTooFine(
  const std::vector<Stroke>& strokes, const Grid& lattice);
}

#endif

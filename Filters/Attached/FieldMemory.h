// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Memory that the offset field of a lattice takes while it is computed.
 */
#ifndef BrainShift_FieldMemory_h
#define BrainShift_FieldMemory_h

#include "Filters/Deformation/Lattice.h"
#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include <string>

namespace brainshift
{
/** Bytes that the offset field of a lattice takes while it is computed. */
VTKBRAINSHIFTFILTERS_EXPORT double offsetFieldBytes(const Lattice& lattice, int samples);

/** Why the offset field of a lattice finds no room; empty if it does. */
VTKBRAINSHIFTFILTERS_EXPORT std::string offsetFieldProblem(const Lattice& lattice, int samples);
}

#endif

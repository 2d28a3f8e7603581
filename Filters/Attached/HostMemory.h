// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Memory of the machine, asked for before it is taken: some systems hand out more than they
 *        have, and end the program later.
 */
#ifndef BrainShift_HostMemory_h
#define BrainShift_HostMemory_h

#include "Filters/Deformation/OffsetField.h"
#include "vtkBrainShiftFiltersModule.h" // for the export macro

#include <string>

namespace brainshift
{
/**
 * Bytes that this process may still take: what the machine has free, or less where the process has
 * a limit. Infinite on a system that does not say.
 */
VTKBRAINSHIFTFILTERS_EXPORT double freeHostMemory();

/** Bytes that the offset field of a lattice takes while it is computed. */
VTKBRAINSHIFTFILTERS_EXPORT double offsetFieldBytes(const Lattice& lattice, int samples);

/**
 * Why memory is not there: one sentence, without a full stop. Empty if it is.
 *
 * @param what    the beginning of the sentence: what needs the memory, with its size
 * @param bytes   that are to be taken
 */
VTKBRAINSHIFTFILTERS_EXPORT std::string hostMemoryProblem(const std::string& what, double bytes);

/** Why the offset field of a lattice finds no room; empty if it does. */
VTKBRAINSHIFTFILTERS_EXPORT std::string offsetFieldProblem(const Lattice& lattice, int samples);

/** Three numbers of a size, such as "91 x 91 x 91". */
VTKBRAINSHIFTFILTERS_EXPORT std::string sizeText(const glm::dvec3& sides);
}

#endif

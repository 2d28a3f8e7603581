// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Memory of the machine, asked for before it is taken: some systems hand out more than they have,
/// and end the program later.
#ifndef BrainShift_HostMemory_h
#define BrainShift_HostMemory_h

#include "Common/Problem.h"

#include "vtkBrainShiftCommonModule.h" // for the export macro

#include <glm/glm.hpp>

namespace brainshift
{
/**
 * Bytes that this process may still take: what the machine has free, or less where the process has
 * a limit. Infinite on a system that does not say.
 */
VTKBRAINSHIFTCOMMON_EXPORT double freeHostMemory();

/**
 * Why memory is not there: one sentence, without a full stop. Empty if it is.
 *
 * @param what    the beginning of the sentence: what needs the memory, with its size
 * @param bytes   that are to be taken
 */
VTKBRAINSHIFTCOMMON_EXPORT std::string hostMemoryProblem(const std::string& what, double bytes);

/** Throws hostMemoryProblem, unless the memory is there. */
VTKBRAINSHIFTCOMMON_EXPORT void requireHostMemory(const std::string& what, double bytes);

/** Three numbers of a size, such as "91 x 91 x 91". */
VTKBRAINSHIFTCOMMON_EXPORT std::string sizeText(const glm::dvec3& sides);
}

#endif

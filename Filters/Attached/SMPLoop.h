// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief The loop of vtkSMPTools, which replaces the core's own loop as soon as the Filters library
 *        is loaded.
 *
 * VTK_SMP_BACKEND_IN_USE names the back end, as it does for VTK's own filters. Debian's
 * ParaView 5.13 leaves vtkSMPTools on one core unless the user names a back end. Our loops take
 * threads there all the same. VTK_SMP_MAX_THREADS limits the threads everywhere.
 */
#ifndef BrainShift_SMPLoop_h
#define BrainShift_SMPLoop_h

#include "Filters/Deformation/Parallel.h"
#include "vtkBrainShiftFiltersModule.h" // for the export macro

namespace brainshift
{
/** Runs the pieces as vtkSMPTools divides them; see Loop in Parallel.h. */
VTKBRAINSHIFTFILTERS_EXPORT void loopWithSMPTools(
  std::int64_t first, std::int64_t last, const LoopBody& body);
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Memory of the machine, asked for before it is taken: some systems hand out more than they have,
/// and end the program later.
#ifndef BrainShift_HostMemory_h
#define BrainShift_HostMemory_h

#include "Common/Problem.h"

#include "vtkBrainShiftCommonModule.h" // for the export macro

#include <glm/glm.hpp>

#include <vector>

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

/// What a process is to take, and on which machine.
struct ProcessNeed
{
  long long machine; ///< see machineNumber
  double bytes;
};

/** A number that all processes of a machine have, and those of another do not. */
VTKBRAINSHIFTCOMMON_EXPORT long long machineNumber();

/** Bytes that the machine has free, whatever limit this process has. Infinite on a system that does
 * not say. */
VTKBRAINSHIFTCOMMON_EXPORT double freeMachineMemory();

/**
 * Why memory is not there for processes that take it at once: one sentence, without a full stop.
 * Empty if it is. Each of them alone may fit.
 *
 * @param what    see hostMemoryProblem
 * @param needs   of all processes
 * @param own     number of the process whose machine is meant
 * @param left    bytes that this machine has free
 */
VTKBRAINSHIFTCOMMON_EXPORT std::string sharedMemoryProblem(
  const std::string& what, const std::vector<ProcessNeed>& needs, std::size_t own, double left);

/** Throws hostMemoryProblem, unless the memory is there. */
VTKBRAINSHIFTCOMMON_EXPORT void requireHostMemory(const std::string& what, double bytes);

/** Three numbers of a size, such as "91 x 91 x 91". */
VTKBRAINSHIFTCOMMON_EXPORT std::string sizeText(const glm::dvec3& sides);

/**
 * While one exists, memory that this process gives back stays with it for what it asks next, and
 * comes in large pages: a system hands out memory page by page, filled with zeros, which takes as
 * long as to compute with it. Afterwards the system gets it. Only glibc is told so.
 */
class VTKBRAINSHIFTCOMMON_EXPORT KeptMemory
{
public:
  KeptMemory();
  ~KeptMemory();
  KeptMemory(const KeptMemory&) = delete;
  KeptMemory& operator=(const KeptMemory&) = delete;
};
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Loops over all processor cores.
///
/// What runs the pieces is chosen when a program is linked. The library BrainShift::Common takes
/// vtkSMPTools (SMPLoop.cxx), so that inside ParaView the settings of VTK hold. A program without
/// VTK links std::thread instead (ThreadLoop.cxx), and so does the build for the thread sanitizer.
#ifndef BrainShift_Parallel_h
#define BrainShift_Parallel_h

#include "Common/Export.h"

#include <cstdint>
#include <functional>

namespace brainshift
{
/** The grain of loops that map points through a deformation: about 0.1 ms of work. */
constexpr std::int64_t MappedOfThread = 256;

/** One piece of a loop: does the steps from `first` up to, but not including, `last`. */
using LoopBody = std::function<void(std::int64_t first, std::int64_t last)>;

/**
 * Calls `body` for pieces that together are the steps from `first` up to, but not including,
 * `last`, and returns when all of them are done. The first exception that a piece throws is thrown
 * again then. A loop that runs within a piece may stay on the piece's thread.
 */
BRAINSHIFT_COMMON_EXPORT void loopInPieces(
  std::int64_t first, std::int64_t last, const LoopBody& body);

/**
 * From now on all loops of the calling thread run on it alone. For threads beside the one that runs
 * pipelines: vtkSMPTools has one state for all threads, and a picture that is drawn meanwhile keeps
 * its cores.
 */
BRAINSHIFT_COMMON_EXPORT void keepLoopsOnThisThread();

/**
 * Calls body(begin, end) for pieces that together are `first` to `last`, on many threads.
 *
 * Pieces must not depend on each other. Then the result equals that of body(first, last), bit for
 * bit. A loop of at most `grain` steps is too short for a second thread: it runs at once.
 */
template <typename Body>
void parallelFor(std::int64_t first, std::int64_t last, std::int64_t grain, const Body& body)
{
  if (last - first <= grain)
  {
    body(first, last);
  }
  else
  {
    loopInPieces(first, last, [&body](std::int64_t begin, std::int64_t end) { body(begin, end); });
  }
}
}

#endif

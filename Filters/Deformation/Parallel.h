// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Loops over all processor cores.
 *
 * The core has a loop of its own, on std::thread, and needs no other library. A program may replace
 * it: the Filters module sets the loop of vtkSMPTools (Filters/Attached/SMPLoop.h), so that inside
 * ParaView the settings of VTK hold.
 */
#ifndef BrainShift_Parallel_h
#define BrainShift_Parallel_h

#include "Filters/Deformation/Export.h"

#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>

namespace brainshift
{
/** One piece of a loop: does the steps from `first` up to, but not including, `last`. */
using LoopBody = std::function<void(std::int64_t first, std::int64_t last)>;

/**
 * Calls `body` for pieces that together are the steps from `first` up to, but not including,
 * `last`, and returns when all of them are done. A loop that runs within a piece stays on the
 * piece's thread.
 */
using Loop = void (*)(std::int64_t first, std::int64_t last, const LoopBody& body);

/**
 * Runs pieces on several threads and keeps the first exception that one of them throws: one that
 * leaves a thread ends the program.
 */
class BRAINSHIFT_DEFORMATION_EXPORT PieceRunner
{
public:
  explicit PieceRunner(const LoopBody& body)
    : Body(body)
  {
  }

  /** Runs one piece, on any thread. */
  void run(std::int64_t first, std::int64_t last);

  /** Throws again what a piece threw. Call it when all threads have ended. */
  void rethrow() const;

private:
  const LoopBody& Body;
  std::mutex Mutex;
  std::exception_ptr Thrown;
};

/**
 * The loop that parallelFor uses by default: one thread for each processor core. The first
 * exception that a piece throws is thrown again when all threads have ended.
 */
BRAINSHIFT_DEFORMATION_EXPORT void loopOnThreads(
  std::int64_t first, std::int64_t last, const LoopBody& body);

/** Makes parallelFor use another loop. Call it before any loop runs. Null: the default. */
BRAINSHIFT_DEFORMATION_EXPORT void setLoop(Loop loop);

/** The loop that parallelFor uses. */
BRAINSHIFT_DEFORMATION_EXPORT Loop currentLoop();

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
    currentLoop()(first, last, [&body](std::int64_t begin, std::int64_t end) { body(begin, end); });
  }
}
}

#endif

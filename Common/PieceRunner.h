// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Keeps an exception in one piece of a parallel loop from ending the program.
#ifndef BrainShift_PieceRunner_h
#define BrainShift_PieceRunner_h

#include "Common/Parallel.h"

#include <exception>
#include <mutex>

namespace brainshift
{
/** Runs pieces on several threads and keeps the first exception that one of them throws. */
class PieceRunner
{
public:
  explicit PieceRunner(const LoopBody& body)
    : Body(body)
  {
  }

  /** Runs one piece, on any thread. */
  void run(std::int64_t first, std::int64_t last)
  {
    try
    {
      this->Body(first, last);
    }
    catch (...)
    {
      const std::lock_guard<std::mutex> lock(this->Mutex);
      this->Thrown = this->Thrown ? this->Thrown : std::current_exception();
    }
  }

  /** Throws again what a piece threw. Call it when all threads have ended. */
  void rethrow() const
  {
    if (this->Thrown)
    {
      std::rethrow_exception(this->Thrown);
    }
  }

private:
  const LoopBody& Body;
  std::mutex Mutex;
  std::exception_ptr Thrown;
};
}

#endif

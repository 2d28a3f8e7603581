// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Deformation/Parallel.h"

#include <algorithm>
#include <thread>
#include <vector>

namespace brainshift
{
namespace
{
Loop chosenLoop = loopOnThreads;
thread_local bool withinPiece = false;
}

void PieceRunner::run(std::int64_t begin, std::int64_t end)
{
  withinPiece = true;
  try
  {
    this->Body(begin, end);
  }
  catch (...)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Thrown = this->Thrown ? this->Thrown : std::current_exception();
  }
  withinPiece = false;
}

void PieceRunner::rethrow() const
{
  if (this->Thrown)
  {
    std::rethrow_exception(this->Thrown);
  }
}

void loopOnThreads(std::int64_t first, std::int64_t last, const LoopBody& body)
{
  const std::int64_t cores = std::max(1u, std::thread::hardware_concurrency());
  const std::int64_t pieces = std::min(cores, last - first);
  if (withinPiece || pieces <= 1)
  {
    body(first, last);
    return;
  }
  const auto start = [&](std::int64_t piece) { return first + (last - first) * piece / pieces; };
  PieceRunner runner(body);
  std::vector<std::thread> threads;
  threads.reserve(pieces - 1);
  for (std::int64_t piece = 1; piece < pieces; ++piece)
  {
    threads.emplace_back([&, piece] { runner.run(start(piece), start(piece + 1)); });
  }
  runner.run(first, start(1));
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  runner.rethrow();
}

void setLoop(Loop loop)
{
  chosenLoop = loop ? loop : loopOnThreads;
}

Loop currentLoop()
{
  return chosenLoop;
}
}

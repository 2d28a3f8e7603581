// SPDX-License-Identifier: BSD-3-Clause
// The parallel loop without VTK: one thread for each processor core.
#include "Common/PieceRunner.h"

#include <algorithm>
#include <thread>
#include <vector>

namespace brainshift
{
namespace
{
thread_local bool withinPiece = false;

void runPiece(PieceRunner& runner, std::int64_t first, std::int64_t last)
{
  withinPiece = true;
  runner.run(first, last);
  withinPiece = false;
}
}

void keepLoopsOnThisThread()
{
  withinPiece = true;
}

void loopInPieces(std::int64_t first, std::int64_t last, const LoopBody& body)
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
    threads.emplace_back([&, piece] { runPiece(runner, start(piece), start(piece + 1)); });
  }
  runPiece(runner, first, start(1));
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  runner.rethrow();
}
}

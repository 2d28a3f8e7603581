// SPDX-License-Identifier: BSD-3-Clause
// Proves that the loop without VTK takes many threads, does every step once and hands on what a
// piece throws.
#include "Common/Parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

using namespace brainshift;

namespace
{
std::vector<int> timesDone(std::int64_t first, std::int64_t last, std::int64_t grain)
{
  std::vector<std::atomic<int>> times(last);
  parallelFor(first, last, grain, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i)
    {
      ++times[i];
    }
  });
  return { times.begin(), times.end() };
}
}

TEST(ParallelFor, DoesEveryStepOnce)
{
  EXPECT_EQ(timesDone(0, 10000, 1), std::vector<int>(10000, 1));
  EXPECT_EQ(timesDone(0, 10000, 9999), std::vector<int>(10000, 1));
  EXPECT_EQ(timesDone(0, 10000, 10000), std::vector<int>(10000, 1));
  EXPECT_EQ(timesDone(0, 1, 0), std::vector<int>(1, 1));
  EXPECT_EQ(timesDone(2, 5, 1), std::vector<int>({ 0, 0, 1, 1, 1 }));
  EXPECT_EQ(timesDone(5, 5, 1), std::vector<int>(5, 0));
}

TEST(ParallelFor, LeavesLittleWorkInOnePiece)
{
  int pieces = 0;
  parallelFor(0, 100, 100, [&](std::int64_t, std::int64_t) { ++pieces; });
  EXPECT_EQ(pieces, 1);
}

TEST(ParallelFor, RunsLoopsWithinLoops)
{
  std::atomic<int> steps{ 0 };
  parallelFor(0, 40, 1, [&](std::int64_t outer, std::int64_t outerEnd) {
    for (; outer < outerEnd; ++outer)
    {
      parallelFor(0, 50, 1,
        [&](std::int64_t begin, std::int64_t end) { steps += static_cast<int>(end - begin); });
    }
  });
  EXPECT_EQ(steps, 40 * 50);
}

TEST(ParallelFor, TakesAThreadForEachCore)
{
  std::mutex mutex;
  std::set<std::thread::id> threads;
  parallelFor(0, 1000, 1, [&](std::int64_t, std::int64_t) {
    const std::lock_guard<std::mutex> lock(mutex);
    threads.insert(std::this_thread::get_id());
  });
  EXPECT_EQ(threads.size(), std::max(1u, std::thread::hardware_concurrency()));
}

TEST(ParallelFor, HandsOnWhatAPieceThrows)
{
  const auto failsLate = [](std::int64_t, std::int64_t last) {
    if (last == 1000)
    {
      throw std::runtime_error("at the end");
    }
  };
  EXPECT_THROW(parallelFor(0, 1000, 1, failsLate), std::runtime_error);
  EXPECT_EQ(timesDone(0, 1000, 1), std::vector<int>(1000, 1)) << "and works again";
}

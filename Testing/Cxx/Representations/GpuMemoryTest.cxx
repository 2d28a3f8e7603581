// SPDX-License-Identifier: BSD-3-Clause
// Proves what a deformed volume is said to need of the GPU's memory, and when that is too much.
#include "Representations/Gpu/GpuMemory.h"
#include "Representations/Gpu/OpenGL.h"
#include "Representations/Gpu/ShaderSource.h"
#include "Testing/Cxx/Representations/TestWindow.h"

#include <gtest/gtest.h>

#include <string>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
constexpr std::int64_t MiB = 1024 * 1024;

// 256 x 256 x 128 voxels of two bytes: 16 MiB.
DrawnSizes largeHead()
{
  DrawnSizes sizes;
  sizes.voxels = { 256, 256, 128 };
  sizes.scalarBytes = 2;
  return sizes;
}
}

TEST(GpuMemory, CountsEachPart)
{
  DrawnSizes sizes = largeHead();
  EXPECT_EQ(memoryNeed(sizes).total(), 16 * MiB);
  sizes.gradients = true;
  EXPECT_EQ(memoryNeed(sizes).gradients, 32 * MiB);
  sizes.halfResolution = true;
  EXPECT_EQ(memoryNeed(sizes).gradients, 4 * MiB);
  sizes.colorBytes = 4;
  EXPECT_EQ(memoryNeed(sizes).colors, 32 * MiB);
  sizes.segmentBytes = 1;
  EXPECT_EQ(memoryNeed(sizes).segment, 8 * MiB);
  sizes.forwardNodes = { 64, 64, 64 };
  sizes.backwardNodes = { 64, 64, 128 };
  EXPECT_EQ(memoryNeed(sizes).field, 12 * MiB);
  sizes.masked = true;
  EXPECT_EQ(memoryNeed(sizes).field, 13 * MiB);
  EXPECT_EQ(memoryNeed(sizes).corrections, 0);
  sizes.corrected = true;
  const std::int64_t corrections = 2 * MiB + CorrectionLayerBytes;
  EXPECT_EQ(memoryNeed(sizes).corrections, corrections);
  sizes.pixels = { 1024, 1024 };
  EXPECT_EQ(memoryNeed(sizes).images, 24 * MiB);
  MemoryNeed need = memoryNeed(sizes);
  EXPECT_EQ(need.total(), (16 + 4 + 32 + 8 + 13 + 24) * MiB + corrections);
  EXPECT_EQ(describeNeed(need).find("reference"), std::string::npos);
  need.reference = 10 * MiB;
  EXPECT_EQ(need.total(), (16 + 4 + 32 + 8 + 13 + 24 + 10) * MiB + corrections);
  EXPECT_NE(describeNeed(need).find("reference 10)"), std::string::npos) << describeNeed(need);
}

TEST(GpuMemory, DoesNotOverflow)
{
  DrawnSizes sizes;
  sizes.voxels = { 4096, 4096, 4096 };
  sizes.scalarBytes = 4;
  EXPECT_EQ(memoryNeed(sizes).scalars, 262144 * MiB);
}

TEST(GpuMemory, SaysWhatIsNeededAndWhatThereIs)
{
  const MemoryNeed need = memoryNeed(largeHead());
  EXPECT_EQ(memoryProblem(need, 0, 0.0, UnknownMemory), "");
  EXPECT_EQ(memoryProblem(need, 0, 16.0, 16.0), "");
  const std::string limited = memoryProblem(need, 0, 15.5, UnknownMemory);
  EXPECT_NE(limited.find("needs 16 MiB (scalars 16,"), std::string::npos) << limited;
  EXPECT_NE(limited.find("Memory Limit allows 15.5 MiB"), std::string::npos) << limited;
  const std::string full = memoryProblem(need, 0, 0.0, 7.25);
  EXPECT_NE(full.find("the GPU has 7.3 MiB left"), std::string::npos) << full;
}

TEST(GpuMemory, CountsWhatIsHeldAlready)
{
  const MemoryNeed need = memoryNeed(largeHead());
  EXPECT_EQ(memoryProblem(need, 12 * MiB, 0.0, 4.0), "");
  EXPECT_NE(memoryProblem(need, 12 * MiB, 0.0, 3.9), "");
}

TEST(GpuMemory, AfterRunningOutAsksForLessOnly)
{
  TestWindow shown;
  GpuMemory memory;
  const MemoryNeed need = memoryNeed(largeHead());
  EXPECT_EQ(memory.ask(shown.window(), need, 0.0), "");
  memory.refuse();
  const std::string problem = memory.ask(shown.window(), need, 0.0);
  EXPECT_NE(problem.find("out of memory"), std::string::npos) << problem;
  EXPECT_NE(problem.find("16 MiB"), std::string::npos) << problem;
  DrawnSizes smaller = largeHead();
  smaller.voxels.z = 64;
  EXPECT_EQ(memory.ask(shown.window(), memoryNeed(smaller), 0.0), "");
  memory.release();
  EXPECT_EQ(memory.ask(shown.window(), need, 0.0), "");
}

TEST(GpuMemory, TellsRunningOutFromOtherErrors)
{
  TestWindow shown;
  takeOutOfMemory();
  EXPECT_FALSE(takeOutOfMemory());
  glEnable(GL_TEXTURE_3D + 1); // no capability: an error, but not that one
  EXPECT_FALSE(takeOutOfMemory());
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST(GpuMemory, DoesNotTakeASilentDriverForAFullOne)
{
  TestWindow shown;
  const double free = freeMemoryMiB(shown.window());
  EXPECT_TRUE(free == UnknownMemory || free > 0.0) << free;
}

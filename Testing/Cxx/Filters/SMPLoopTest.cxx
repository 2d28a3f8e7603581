// SPDX-License-Identifier: BSD-3-Clause
// Proves that our loops are those of vtkSMPTools, take many threads where nobody chose otherwise,
// and give the bits that one thread gives.
#include "Common/Parallel.h"
#include "Filters/Deformation/LatticeExtremes.h"
#include "Testing/Cxx/Filters/TestPipeline.h"

#include <vtkSMPTools.h>

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <mutex>
#include <string>
#include <vector>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
constexpr const char* BackendVariable = "VTK_SMP_BACKEND_IN_USE";

// The back end as a user may find or choose it, put back afterwards.
class SMPLoopTest : public ::testing::Test
{
protected:
  SMPLoopTest()
  {
    const char* variable = std::getenv(BackendVariable);
    this->HadVariable = variable != nullptr;
    this->Variable = variable ? variable : "";
    unsetenv(BackendVariable);
  }
  ~SMPLoopTest() override
  {
    vtkSMPTools::SetBackend(this->Backend.c_str());
    if (this->HadVariable)
    {
      setenv(BackendVariable, this->Variable.c_str(), 1);
    }
  }

  // As a user who wants one thread does it: by the environment before VTK starts.
  void chooseSequential()
  {
    setenv(BackendVariable, "Sequential", 1);
    vtkSMPTools::SetBackend("Sequential");
  }

  std::string Backend = vtkSMPTools::GetBackend();

private:
  bool HadVariable = false;
  std::string Variable;
};

// The back end that a loop's body meets.
std::string backendWithin()
{
  std::string backend;
  std::mutex mutex;
  parallelFor(0, 1000, 1, [&](vtkIdType, vtkIdType) {
    const std::lock_guard<std::mutex> lock(mutex);
    backend = vtkSMPTools::GetBackend();
  });
  return backend;
}

std::vector<int> timesDone(vtkIdType first, vtkIdType last, vtkIdType grain)
{
  std::vector<std::atomic<int>> times(last);
  parallelFor(first, last, grain, [&](vtkIdType begin, vtkIdType end) {
    for (vtkIdType i = begin; i < end; ++i)
    {
      ++times[i];
    }
  });
  return { times.begin(), times.end() };
}

// Bytes of a bent and baked volume, large enough for every loop to be divided.
std::vector<unsigned char> bakedBytes()
{
  const Grid grid = plainGrid({ 70, 60, 50 }, glm::dvec3(1.0));
  auto volume =
    volumeOn(grid, VTK_UNSIGNED_CHAR, [](vtkIdType i) { return (i * 7919 + i / 70 * 31) % 251; });
  vtkNew<vtkFreeFormDeformation> bend;
  bend->SetInputData(volume);
  bend->SetLatticeDimensions(37, 37, 37);
  setStrokes(bend, { strokeAt(Tool::Stamp, { 30, 30, 20 }, { 5, -3, 4 }) });
  vtkNew<vtkBakeDeformation> bake;
  bake->SetInputConnection(bend->GetOutputPort());
  bake->Update();
  auto first = static_cast<const unsigned char*>(bake->GetOutput()->GetScalarPointer());
  return { first, first + grid.count() };
}

double bentJacobian()
{
  Lattice lattice = makeLattice(plainGrid(glm::ivec3(37), glm::dvec3(3.0)), 0);
  applyStroke(lattice, strokeAt(Tool::Stamp, { 50, 50, 40 }, { 6, -3, 4 }));
  return minimumJacobian(lattice);
}
}

TEST_F(SMPLoopTest, DoesEveryStepOnce)
{
  EXPECT_EQ(timesDone(0, 10000, 1), std::vector<int>(10000, 1));
  EXPECT_EQ(timesDone(0, 10000, 9999), std::vector<int>(10000, 1));
  EXPECT_EQ(timesDone(0, 10000, 10000), std::vector<int>(10000, 1));
  EXPECT_EQ(timesDone(0, 1, 0), std::vector<int>(1, 1));
  EXPECT_EQ(timesDone(2, 5, 1), std::vector<int>({ 0, 0, 1, 1, 1 }));
  EXPECT_EQ(timesDone(5, 5, 1), std::vector<int>(5, 0));
}

TEST_F(SMPLoopTest, TakesThreadsWhereNobodyChose)
{
  EXPECT_STRNE(backendWithin().c_str(), "Sequential");
  EXPECT_EQ(vtkSMPTools::GetBackend(), this->Backend) << "for the loop only";
}

TEST_F(SMPLoopTest, TakesWhatTheUserChose)
{
  this->chooseSequential();
  EXPECT_EQ(backendWithin(), "Sequential");
  vtkSMPTools::SetBackend("STDThread");
  EXPECT_EQ(backendWithin(), "STDThread");
}

TEST_F(SMPLoopTest, RunsLoopsWithinLoops)
{
  std::atomic<int> steps{ 0 };
  parallelFor(0, 40, 1, [&](vtkIdType outer, vtkIdType outerEnd) {
    for (; outer < outerEnd; ++outer)
    {
      parallelFor(
        0, 50, 1, [&](vtkIdType begin, vtkIdType end) { steps += static_cast<int>(end - begin); });
    }
  });
  EXPECT_EQ(steps, 40 * 50);
}

TEST_F(SMPLoopTest, GivesTheBitsOfOneThread)
{
  const std::vector<unsigned char> baked = bakedBytes();
  const double jacobian = bentJacobian();
  this->chooseSequential();
  EXPECT_EQ(baked, bakedBytes());
  EXPECT_EQ(jacobian, bentJacobian());
}

// SPDX-License-Identifier: BSD-3-Clause
// Proves that filters ask for memory before they take it: what does not fit is refused with a
// sentence that names its size and what is left, and the next thing that fits is made.
#include "Common/HostMemory.h"
#include "Testing/Cxx/Filters/TestPipeline.h"
#include "vtkDeformationField.h"

#include <gtest/gtest.h>

#include <fstream>

#ifdef __linux__
#include <sys/resource.h>
#include <unistd.h>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
// While this lives, the process may take no more than so many bytes.
class LittleMemory
{
public:
  explicit LittleMemory(double bytes)
  {
    double pages = 0.0;
    std::ifstream("/proc/self/statm") >> pages;
    getrlimit(RLIMIT_AS, &this->Before);
    const double taken = pages * static_cast<double>(sysconf(_SC_PAGESIZE));
    const rlimit limit{ static_cast<rlim_t>(taken + bytes), this->Before.rlim_max };
    setrlimit(RLIMIT_AS, &limit);
  }
  ~LittleMemory() { setrlimit(RLIMIT_AS, &this->Before); }

private:
  rlimit Before{};
};

constexpr double GB = 1e9;
const Grid VolumeGrid = plainGrid(glm::ivec3(33), glm::dvec3(1.0));

vtkSmartPointer<vtkImageData> smallVolume()
{
  return volumeOn(VolumeGrid, VTK_FLOAT, [](vtkIdType i) { return i % 100; });
}

// What a filter says while there is room for 2 GB.
std::string saidWithin2GB(vtkAlgorithm* filter)
{
  const LittleMemory little(2.0 * GB);
  Errors errors(filter);
  EXPECT_NO_THROW(filter->Update());
  return errors.take();
}

void expectSays(const std::string& said, std::initializer_list<const char*> words)
{
  for (const char* word : words)
  {
    EXPECT_NE(said.find(word), std::string::npos) << word << " is not in: " << said;
  }
}
}

TEST(HostMemory, KnowsTheLimitOfTheProcess)
{
  EXPECT_GT(freeHostMemory(), 100e6);
  const LittleMemory little(1.0 * GB);
  EXPECT_LE(freeHostMemory(), 1.0 * GB);
  EXPECT_GT(freeHostMemory(), 0.5 * GB);
  EXPECT_EQ(hostMemoryProblem("It", 0.3 * GB), "");
  expectSays(
    hostMemoryProblem("It", 5.0 * GB), { "It needs 5 GB of memory, and ", " GB are left; close" });
}

// Processes of one machine take memory at once, so what each finds free is there for only one.
TEST(HostMemory, ProcessesOfOneMachineShareWhatIsFree)
{
  constexpr long long Here = 7;
  constexpr long long Elsewhere = 8;
  const std::vector<ProcessNeed> needs{ { Here, 3.0 * GB }, { Elsewhere, 9.0 * GB },
    { Here, 2.0 * GB } };
  EXPECT_EQ(sharedMemoryProblem("It", needs, 0, 5.0 * GB), "");
  EXPECT_EQ(sharedMemoryProblem("It", needs, 1, 9.0 * GB), "");
  expectSays(sharedMemoryProblem("It", needs, 0, 4.0 * GB),
    { "It needs 3 GB of memory, together with other ranks of its machine 5 GB, and 4 GB are "
      "left" });
  expectSays(sharedMemoryProblem("It", needs, 2, 4.0 * GB), { "It needs 2 GB of memory" });
  expectSays(sharedMemoryProblem("It", needs, 1, 4.0 * GB), { "machine 9 GB, and 4 GB are left" });
  EXPECT_EQ(sharedMemoryProblem("It", { { Here, 1e6 }, { Here, 1e6 } }, 0, 0.0), "")
    << "too little";
}

TEST(HostMemory, AMachineHasOneNumber)
{
  EXPECT_NE(machineNumber(), 0);
  EXPECT_EQ(machineNumber(), machineNumber());
  const LittleMemory little(1e6);
  EXPECT_GT(freeMachineMemory(), 1e6) << "whatever this process may take";
}

TEST(HostMemory, ABakeAsksForItsField)
{
  vtkNew<vtkFreeFormDeformation> deform;
  deform->SetInputData(smallVolume());
  deform->SetLatticeDimensions(129, 129, 129);
  deform->SetSamples(16);
  vtkNew<vtkBakeDeformation> bake;
  bake->SetInputConnection(deform->GetOutputPort());
  expectSays(saidWithin2GB(bake),
    { "The offset field of 2177 x 2177 x 2177 nodes needs 255 GB of memory, and ",
      " GB are left; close" });
  EXPECT_EQ(bake->GetOutput()->GetNumberOfPoints(), 0);
  deform->SetLatticeDimensions(9, 9, 9);
  deform->SetSamples(4);
  EXPECT_EQ(saidWithin2GB(bake), "");
  EXPECT_EQ(bake->GetOutput()->GetNumberOfPoints(), 33 * 33 * 33);
}

// Tissue that leaves the volume widens the field.
TEST(HostMemory, ABakeOfAFarMoveIsRefused)
{
  vtkNew<vtkFreeFormDeformation> deform;
  deform->SetInputData(smallVolume());
  vtkNew<vtkBakeDeformation> bake;
  bake->SetInputConnection(deform->GetOutputPort());
  const Grid corners = withDimensions(VolumeGrid, glm::ivec3(2));
  const auto movedBy = [&](const glm::dvec3& shift) {
    deform->SetInputDataObject(1, fieldOn(corners, [&](const glm::dvec3&) { return shift; }));
    return saidWithin2GB(bake);
  };
  expectSays(movedBy(glm::dvec3(1e4)),
    { "The offset field of ", " nodes needs ", " GB of memory, and ", " GB are left; close" });
  EXPECT_EQ(bake->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(movedBy(glm::dvec3(5.0)), "");
  EXPECT_EQ(bake->GetOutput()->GetNumberOfPoints(), 33 * 33 * 33);
}

TEST(HostMemory, ADeformationFieldAsksForItsPoints)
{
  vtkNew<vtkFreeFormDeformation> deform;
  deform->SetInputData(smallVolume());
  vtkNew<vtkDeformationField> field;
  field->SetInputConnection(deform->GetOutputPort());
  field->SetSampleGrid(vtkDeformationField::GivenDimensions);
  field->SetDimensions(4096, 4096, 4096);
  expectSays(saidWithin2GB(field),
    { "A field of 4096 x 4096 x 4096 points needs 1100 GB of memory, and ",
      " GB are left; close" });
  EXPECT_EQ(field->GetOutput()->GetNumberOfPoints(), 0);
  field->SetDimensions(5, 6, 7);
  EXPECT_EQ(saidWithin2GB(field), "") << "what was refused is forgotten";
  EXPECT_EQ(field->GetOutput()->GetNumberOfPoints(), 5 * 6 * 7);
}

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST(KeptMemory, StaysWithTheProcessAndGoesBackAtTheEnd)
{
  const auto resident = [] {
    double all = 0.0;
    double here = 0.0;
    std::ifstream("/proc/self/statm") >> all >> here;
    return here * static_cast<double>(sysconf(_SC_PAGESIZE));
  };
  const auto takeAndGiveBack = [] {
    const std::vector<char> bytes(200000000, 1);
    EXPECT_EQ(bytes.back(), 1);
  };
  const double before = resident();
  {
    const KeptMemory kept;
    takeAndGiveBack();
    EXPECT_GT(resident(), before + 0.15 * GB);
  }
  EXPECT_LT(resident(), before + 0.05 * GB);
}
#endif
#endif

// SPDX-License-Identifier: BSD-3-Clause
// Proves that no exception leaves a filter, from whichever thread: the filter reports an error that
// says why, and works again afterwards, also after a filter that read it is gone.
#include "Common/Guard.h"
#include "Common/Parallel.h"
#include "Testing/Cxx/Filters/TestPipeline.h"

#include <vtkImageAlgorithm.h>
#include <vtkObjectFactory.h>

#include <gtest/gtest.h>

#include <functional>
#include <new>
#include <stdexcept>

using namespace brainshift;
using namespace brainshift::testing;

namespace
{
// An algorithm whose request for data does what the test wants.
class Thrower : public vtkImageAlgorithm
{
public:
  static Thrower* New();
  vtkTypeMacro(Thrower, vtkImageAlgorithm);
  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  std::function<void()> Step;
  bool Done = false;

protected:
  Thrower() { this->SetNumberOfInputPorts(0); }

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override
  {
    this->Done = false;
    this->Step();
    this->Done = true;
    return 1;
  }
};

vtkStandardNewMacro(Thrower);
brainshiftGuardRequestsMacro(Thrower);

// Reads another algorithm.
class Reader : public vtkImageAlgorithm
{
public:
  static Reader* New();
  vtkTypeMacro(Reader, vtkImageAlgorithm);

protected:
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override
  {
    return 1;
  }
};

vtkStandardNewMacro(Reader);

std::string errorsOf(Thrower* filter, const std::function<void()>& step)
{
  Errors errors(filter);
  filter->Step = step;
  filter->Modified();
  EXPECT_NO_THROW(filter->Update());
  return errors.take();
}

void throwOutOfRange()
{
  throw std::out_of_range("there is no such place");
}
}

TEST(Guard, TurnsExceptionsIntoErrors)
{
  vtkNew<Thrower> filter;
  const auto says = [&](const std::string& said, const char* words) {
    EXPECT_NE(said.find(words), std::string::npos) << said;
    EXPECT_FALSE(filter->Done);
  };
  says(errorsOf(filter, [] { throw std::bad_alloc(); }),
    "Thrower needs more memory than this machine has left.");
  says(errorsOf(filter, [] { throw std::length_error("vector"); }),
    "Thrower needs more memory than any machine has.");
  says(errorsOf(filter, throwOutOfRange), "Thrower failed: there is no such place.");
  says(errorsOf(filter, [] { throw 7; }), "Thrower failed for an unknown reason.");
  EXPECT_EQ(errorsOf(filter, [] {}), "");
  EXPECT_TRUE(filter->Done);
}

TEST(Guard, HoldsForThreads)
{
  vtkNew<Thrower> filter;
  const std::string said = errorsOf(filter, [&] {
    loopInPieces(0, 1000, [](std::int64_t first, std::int64_t last) {
      if (first <= 990 && 990 < last)
      {
        throw std::bad_alloc();
      }
    });
  });
  EXPECT_NE(said.find("Thrower needs more memory"), std::string::npos) << said;
}

TEST(Guard, AReaderMayBeGone)
{
  vtkNew<Thrower> filter;
  filter->Step = [] {};
  for (int kept = 0; kept < 2; ++kept)
  {
    vtkNew<Reader> gone;
    gone->SetInputConnection(filter->GetOutputPort());
    gone->Update();
  }
  EXPECT_NE(errorsOf(filter, throwOutOfRange), "");
  vtkNew<Reader> there;
  there->SetInputConnection(filter->GetOutputPort());
  EXPECT_NE(errorsOf(filter, throwOutOfRange), "");
  EXPECT_EQ(errorsOf(filter, [] {}), "");
}

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Runs the reader of NIfTI on a file of the test's scratch folder and keeps what it says.
#ifndef BrainShift_NIFTITestReading_h
#define BrainShift_NIFTITestReading_h

#include "Testing/Formats/Volumes/VolumeFormatTesting.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkExecutive.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <string>

namespace brainshift::testing
{
inline std::string temporary(const std::string& name)
{
  return std::string(BRAINSHIFT_TEST_TEMP) + "/NIFTIReaderTest-" + name;
}

// A reader that collects what it would tell the user.
class Reading
{
public:
  explicit Reading(const std::string& fileName)
  {
    this->Collect->SetClientData(this);
    this->Collect->SetCallback([](vtkObject*, unsigned long event, void* self, void* text) {
      auto* reading = static_cast<Reading*>(self);
      (event == vtkCommand::ErrorEvent ? reading->errors : reading->warnings) +=
        static_cast<const char*>(text);
    });
    for (unsigned long event : { vtkCommand::ErrorEvent, vtkCommand::WarningEvent })
    {
      this->reader->AddObserver(event, this->Collect);
      this->reader->GetExecutive()->AddObserver(event, this->Collect);
    }
    this->reader->SetFileName(fileName.c_str());
    this->reader->Update();
  }

  vtkImageData* image() { return this->reader->GetOutput(); }
  vtkDataArray* scalars() { return this->image()->GetPointData()->GetScalars(); }

  NIFTI reader;
  std::string errors;
  std::string warnings;

private:
  vtkNew<vtkCallbackCommand> Collect;
};
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Volumes/WriterAtWork.h"

#include "vtkAlgorithm.h"

namespace brainshift
{
namespace
{
vtkAlgorithm* Writer = nullptr; // of the main thread, as all VTK pipelines
}

WriterAtWork::WriterAtWork(vtkAlgorithm* writer)
{
  Writer = writer;
}

WriterAtWork::~WriterAtWork()
{
  Writer = nullptr;
}

vtkAlgorithm* WriterAtWork::find()
{
  return Writer;
}

bool WriterAtWork::goesOn()
{
  if (Writer)
  {
    Writer->UpdateProgress(Writer->GetProgress());
  }
  return !Writer || !Writer->GetAbortExecute();
}
}

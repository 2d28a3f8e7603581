// SPDX-License-Identifier: BSD-3-Clause
#include "Formats/Volumes/WriterAtWork.h"

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
}

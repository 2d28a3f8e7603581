// SPDX-License-Identifier: BSD-3-Clause
#include "Common/Guard.h"

#include "Common/Problem.h"

#include "vtkExecutive.h"
#include "vtkInformation.h"
#include "vtkInformationExecutivePortVectorKey.h"
#include "vtkInformationVector.h"
#include "vtkObject.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <exception>
#include <new>

namespace brainshift
{
std::string thrownReason()
{
  try
  {
    throw;
  }
  catch (const std::bad_alloc&)
  {
    return "needs more memory than this machine has left";
  }
  catch (const std::length_error&)
  {
    return "needs more memory than any machine has";
  }
  catch (const std::exception& thrown)
  {
    return std::string("failed: ") + thrown.what();
  }
  catch (...)
  {
    return "failed for an unknown reason";
  }
}

std::string thrownSentence(const std::string& subject)
{
  try
  {
    throw;
  }
  catch (const Problem& problem)
  {
    return problem.what();
  }
  catch (...)
  {
    return subject + " " + thrownReason();
  }
}

void reportThrown(vtkObject* object)
{
  vtkErrorWithObjectMacro(object, << thrownSentence(object->GetClassName()) << ".");
}

void warn(vtkObject* object, const std::string& sentence)
{
  vtkWarningWithObjectMacro(object, << sentence << ".");
}

void warnAnew(vtkObject* object, const std::string& sentence, std::string& last)
{
  if (sentence != last && !sentence.empty())
  {
    warn(object, sentence);
  }
  last = sentence;
}

namespace
{
// VTK keeps the addresses of readers that were deleted while they were connected. A reader that is
// there holds a reference to what it reads, and the producer holds one: with fewer of them, an
// address is that of nothing.
bool areReadersThere(vtkInformation* output)
{
  return output->GetReferenceCount() > vtkExecutive::CONSUMERS()->Length(output);
}
}

void forgetExtents(vtkInformationVector* outputs)
{
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    vtkInformation* info = outputs->GetInformationObject(port);
    info->Remove(vtkStreamingDemandDrivenPipeline::COMBINED_UPDATE_EXTENT());
    if (!areReadersThere(info))
    {
      continue;
    }
    // What reads this output keeps its request, too.
    vtkExecutive** const readers = vtkExecutive::CONSUMERS()->GetExecutives(info);
    for (int reader = 0; reader < vtkExecutive::CONSUMERS()->Length(info); ++reader)
    {
      forgetExtents(readers[reader]->GetOutputInformation());
    }
  }
}
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Common/RankInputs.h"

#include "Common/RankAgreement.h"

#include "vtkAlgorithm.h"
#include "vtkAlgorithmOutput.h"
#include "vtkExecutive.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkMultiProcessController.h"

namespace brainshift
{
namespace
{
// Passes a request on to all inputs, as VTK does. VTK asks again after it, and they have it done.
bool inputsWork(vtkAlgorithm* filter, vtkInformation* request)
{
  const int asked = request->Get(vtkExecutive::FROM_OUTPUT_PORT());
  bool work = true;
  for (int port = 0; port < filter->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < filter->GetNumberOfInputConnections(port); ++i)
    {
      vtkExecutive* input = filter->GetInputExecutive(port, i);
      request->Set(
        vtkExecutive::FROM_OUTPUT_PORT(), filter->GetInputConnection(port, i)->GetIndex());
      work = input->ProcessRequest(
               request, input->GetInputInformation(), input->GetOutputInformation()) &&
        work;
      request->Set(vtkExecutive::FROM_OUTPUT_PORT(), asked);
    }
  }
  return work;
}
}

bool inputsWorkOnAllRanks(vtkAlgorithm* filter, vtkInformation* request, int when)
{
  vtkMultiProcessController* ranks = severalRanks();
  if (!ranks || when != vtkExecutive::BeforeForward)
  {
    return true;
  }
  const std::string problem = problemOnAny(
    ranks, inputsWork(filter, request) ? "" : "an input failed, and that rank reported why");
  if (!problem.empty() && ranks->GetLocalProcessId() == 0)
  {
    vtkErrorWithObjectMacro(filter, << problem << ".");
  }
  return problem.empty();
}
}

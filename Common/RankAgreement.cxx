// SPDX-License-Identifier: BSD-3-Clause
#include "Common/RankAgreement.h"

#include "vtkCommunicator.h"
#include "vtkMultiProcessController.h"

namespace brainshift
{
vtkMultiProcessController* severalRanks()
{
  vtkMultiProcessController* ranks = vtkMultiProcessController::GetGlobalController();
  return ranks && ranks->GetNumberOfProcesses() > 1 ? ranks : nullptr;
}

bool isTrueOnAny(vtkMultiProcessController* ranks, bool here)
{
  const int own = here;
  int any = 0;
  ranks->AllReduce(&own, &any, 1, vtkCommunicator::MAX_OP);
  return any != 0;
}

std::string problemOnAny(vtkMultiProcessController* ranks, const std::string& here)
{
  const int count = ranks->GetNumberOfProcesses();
  const int own = here.empty() ? count : ranks->GetLocalProcessId();
  int first = count;
  ranks->AllReduce(&own, &first, 1, vtkCommunicator::MIN_OP);
  if (first == count)
  {
    return {};
  }
  return "MPI rank " + std::to_string(first) + " of " + std::to_string(count) + ": " +
    textOf(ranks, here, first);
}

std::string textOf(vtkMultiProcessController* ranks, const std::string& here, int rank)
{
  std::string text = here;
  int length = static_cast<int>(text.size());
  ranks->Broadcast(&length, 1, rank);
  text.resize(length);
  ranks->Broadcast(text.data(), length, rank);
  return text;
}

Box boxOfAll(vtkMultiProcessController* ranks, const Box& here)
{
  Box own = here; // with the least negated, so that one maximum finds all
  for (int axis = 0; axis < 3; ++axis)
  {
    own[2 * axis] = -own[2 * axis];
  }
  Box all = own;
  ranks->AllReduce(own.data(), all.data(), 6, vtkCommunicator::MAX_OP);
  for (int axis = 0; axis < 3; ++axis)
  {
    all[2 * axis] = -all[2 * axis];
  }
  return all;
}
}

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

int firstRankWhere(vtkMultiProcessController* ranks, bool here)
{
  const int own = here ? ranks->GetLocalProcessId() : ranks->GetNumberOfProcesses();
  int first = own;
  ranks->AllReduce(&own, &first, 1, vtkCommunicator::MIN_OP);
  return first;
}

std::string problemOnAny(vtkMultiProcessController* ranks, const std::string& here)
{
  const int first = firstRankWhere(ranks, !here.empty());
  return first == ranks->GetNumberOfProcesses()
    ? std::string()
    : saidByRank(ranks, first, textOf(ranks, here, first));
}

std::string saidByRank(vtkMultiProcessController* ranks, int rank, const std::string& sentence)
{
  return "MPI rank " + std::to_string(rank) + " of " +
    std::to_string(ranks->GetNumberOfProcesses()) + ": " + sentence;
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

std::vector<Box> boxesOfAll(vtkMultiProcessController* ranks, const Box& here)
{
  std::vector<Box> all(ranks->GetNumberOfProcesses());
  ranks->AllGather(here.data(), all[0].data(), 6);
  return all;
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

// SPDX-License-Identifier: BSD-3-Clause
#include "Representations/Scene/Remarks.h"

#include "Common/Guard.h"
#include "Common/RankAgreement.h"

#include "vtkAbstractArray.h"
#include "vtkCellData.h"
#include "vtkDataSet.h"
#include "vtkMultiProcessController.h"
#include "vtkPointData.h"
#include "vtkVolumeMapper.h"
#include "vtkWeakPointer.h"

#include <algorithm>
#include <map>
#include <vector>

namespace brainshift
{
namespace
{
// What this rank said and the first one did not tell yet.
std::vector<std::string>& untold()
{
  static std::vector<std::string> sentences;
  return sentences;
}

void keepForFirstRank(const std::string& sentence)
{
  if (severalRanks())
  {
    untold().push_back(sentence);
  }
}

// Whether nothing of this process has said the sentence of this volume before.
bool isNewRemark(vtkDataSet* volume, const std::string& sentence)
{
  using Volumes = std::vector<vtkWeakPointer<vtkAbstractArray>>;
  static std::map<std::string, Volumes> said;
  vtkAbstractArray* ofPoints = volume ? volume->GetPointData()->GetAbstractArray(0) : nullptr;
  vtkAbstractArray* array =
    ofPoints || !volume ? ofPoints : volume->GetCellData()->GetAbstractArray(0);
  if (!array)
  {
    return true;
  }
  Volumes& volumes = said[sentence];
  const auto isDeleted = [](vtkAbstractArray* other) { return !other; };
  volumes.erase(std::remove_if(volumes.begin(), volumes.end(), isDeleted), volumes.end());
  if (std::find(volumes.begin(), volumes.end(), array) != volumes.end())
  {
    return false;
  }
  volumes.emplace_back(array);
  return true;
}
}

void tellOnce(vtkVolumeMapper* mapper, const std::string& remark, std::set<std::string>& told)
{
  if (!remark.empty() && told.insert(remark).second &&
    isNewRemark(mapper->GetDataSetInput(), remark))
  {
    warn(mapper, remark);
    keepForFirstRank(remark);
  }
}

void reportOnce(vtkVolumeMapper* mapper, const std::string& problem, const std::string& instead,
  std::string& reported)
{
  if (!problem.empty() && problem != reported)
  {
    const std::string sentence = problem + ". " + instead;
    vtkErrorWithObjectMacro(mapper, << sentence << ".");
    keepForFirstRank(sentence);
  }
  reported = problem;
}

void tellOfOtherRanks(vtkObject* teller)
{
  vtkMultiProcessController* ranks = severalRanks();
  std::vector<std::string>& own = untold();
  while (ranks)
  {
    const int rank = firstRankWhere(ranks, !own.empty());
    if (rank == ranks->GetNumberOfProcesses())
    {
      return;
    }
    const std::string sentence = textOf(ranks, own.empty() ? std::string() : own.front(), rank);
    own.erase(std::remove(own.begin(), own.end(), sentence), own.end());
    if (rank > 0 && ranks->GetLocalProcessId() == 0)
    {
      warn(teller, saidByRank(ranks, rank, sentence));
    }
  }
}
}

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What mappers tell the user. Two views of one volume warn of the same thing once. Users see what
/// the first of several MPI ranks says, so it tells what the others said, too.
#ifndef BrainShift_Remarks_h
#define BrainShift_Remarks_h

#include <set>
#include <string>

class vtkObject;
class vtkVolumeMapper;

namespace brainshift
{
/// Warns of a remark on a mapper's volume, unless it was told before: by this mapper or another one
/// of this process. Volumes that share their first array are one volume.
///
/// @param remark   without a full stop; empty: there is none
/// @param told     what this mapper told
void tellOnce(vtkVolumeMapper* mapper, const std::string& remark, std::set<std::string>& told);

/// Reports why a mapper failed, unless it reported the same the last time.
///
/// @param problem    without a full stop; empty: it did not fail, and a later problem is new
/// @param instead    says what is seen instead, without a full stop
/// @param reported   the last problem; becomes `problem`
void reportOnce(vtkVolumeMapper* mapper, const std::string& problem, const std::string& instead,
  std::string& reported);

/// Tells on the first of several MPI ranks what was told on others since the last call: each
/// sentence once, with its rank before it. All ranks must call it together.
void tellOfOtherRanks(vtkObject* teller);
}

#endif

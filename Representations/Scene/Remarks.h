// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What was said of a volume before, by any mapper of this process: two views of one volume warn of
/// the same thing once.
#ifndef BrainShift_Remarks_h
#define BrainShift_Remarks_h

#include <string>

class vtkDataSet;

namespace brainshift
{
/// Whether nothing of this process has said the sentence of this volume before. Volumes that share
/// their first array are one volume.
bool isNewRemark(vtkDataSet* volume, const std::string& sentence);
}

#endif

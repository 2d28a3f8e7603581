// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Names and colours of labels in the header extension of a NIfTI file.
 *
 * Connectome Workbench stores them as XML in an extension with code 30:
 * <Label Key="1" Red="1" Green="0.5" Blue="0" Alpha="1"><![CDATA[name]]></Label>
 */
#ifndef BrainShift_NIFTILabels_h
#define BrainShift_NIFTILabels_h

#include "Common/LabelTable.h"

#include <string>
#include <vector>

namespace brainshift
{
/** The labels of the first such extension of a .nii or .nii.gz file; none if it has none. */
std::vector<Label> niftiLabels(const std::string& fileName);
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Displacement fields in NIfTI files (.nii, .nii.gz).
 *
 * Written: intent 1006 (DISPVECT), vectors in RAS, which ITK from 5.4 on turns into LPS when it
 * reads them; intent_name holds the direction.
 *
 * Read: intent 1006 (vectors in RAS); intent 1007 (VECTOR) as ITK, ANTs and elastix write it
 * (vectors in LPS); and intent 1007 of NiftyReg (vectors in RAS; intent_p1 0: positions, 1:
 * displacements).
 */
#ifndef BrainShift_NIFTIField_h
#define BrainShift_NIFTIField_h

#include "Formats/Fields/FieldFile.h"

#include <string>

namespace brainshift
{
/** Whether a file holds vectors of one of the intents above. */
bool isNIFTIField(const std::string& fileName);

/** Reads a field. Returns one sentence on what went wrong, or nothing. */
std::string readNIFTIField(const std::string& fileName, DirectedField& field);

/** Writes a field. Returns one sentence on what went wrong, or nothing. */
std::string writeNIFTIField(const std::string& fileName, const DirectedField& field);
}

#endif

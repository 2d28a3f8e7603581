// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief Displacement fields in MetaImage and NRRD files: a header of lines, then the numbers or
 *        the name of the file that holds them.
 */
#ifndef BrainShift_TextHeaderField_h
#define BrainShift_TextHeaderField_h

#include "Formats/Fields/FieldFile.h"

#include <string>

namespace brainshift
{
/** Whether a file has the header of a field. */
bool isTextHeaderField(const std::string& fileName);

/** Reads a field of either format. Returns one sentence on what went wrong, or nothing. */
std::string readTextHeaderField(const std::string& fileName, DirectedField& field);

/** Writes a MetaImage (.mha, .mhd). Returns one sentence on what went wrong, or nothing. */
std::string writeMetaImageField(const std::string& fileName, const DirectedField& field);

/** Writes an NRRD (.nrrd). Returns one sentence on what went wrong, or nothing. */
std::string writeNRRDField(const std::string& fileName, const DirectedField& field);
}

#endif

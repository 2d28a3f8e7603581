// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief What the lines of an NRRD header mean. Names such as `space directions` are those of the
 *        format (teem.sourceforge.net/nrrd/format.html).
 */
#ifndef BrainShift_NRRDHeader_h
#define BrainShift_NRRDHeader_h

#include "Formats/Files/TextHeader.h"

#include <string>

namespace brainshift
{
/**
 * Fills `header` from its text. The measurement frame is ignored: numbers are taken as they are.
 * Returns the end of a sentence, after the name of the file, on what is wrong; empty if nothing is.
 */
std::string fromNRRD(const std::string& fileName, TextHeader& header);
}

#endif

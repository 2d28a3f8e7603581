// SPDX-License-Identifier: BSD-3-Clause
// The formats behind FieldFile.h. Each returns one sentence on what went wrong, or nothing.
#ifndef BrainShift_FieldFileFormats_h
#define BrainShift_FieldFileFormats_h

#include "Filters/Files/FieldFile.h"

#include <string>

namespace brainshift
{
bool isNIFTIField(const std::string& fileName);
std::string readNIFTIField(const std::string& fileName, FieldFile& field);
std::string writeNIFTIField(const std::string& fileName, const FieldFile& field);

// MetaImage and NRRD: a header of lines, then the numbers or the name of their file.
bool isTextHeaderField(const std::string& fileName);
std::string readTextHeaderField(const std::string& fileName, FieldFile& field);
std::string writeMetaImageField(const std::string& fileName, const FieldFile& field);
std::string writeNRRDField(const std::string& fileName, const FieldFile& field);
}

#endif

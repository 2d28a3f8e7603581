// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief One word about a data object, in a field array of one string.
 */
#ifndef BrainShift_FieldWord_h
#define BrainShift_FieldWord_h

#include <string>

class vtkDataObject;

namespace brainshift
{
/** Attaches a word under a name. It replaces the one before. An empty word removes the array. */
void setFieldWord(vtkDataObject* data, const char* name, const std::string& word);

/** The word under a name; empty without one, and for null. */
std::string fieldWordOf(vtkDataObject* data, const char* name);
}

#endif

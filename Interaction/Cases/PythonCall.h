// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Calls a function in the window's own Python.
#ifndef BrainShift_PythonCall_h
#define BrainShift_PythonCall_h

#include <optional>
#include <string>

namespace brainshift
{
/// What `function` of `module` returns for a text, in UTF-8. Nothing if it raised an error, which
/// ParaView's output shows then, or returned no text.
std::optional<std::string> callPython(
  const char* module, const char* function, const std::string& text);
}

#endif

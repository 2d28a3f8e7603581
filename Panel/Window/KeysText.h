// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The table of commands as text: for the help window, and for Documentation/keys.md, which a test
/// compares with it.
#ifndef BrainShift_KeysText_h
#define BrainShift_KeysText_h

#include <QString>

namespace brainshift
{
/// All of the table as rich text, a section for each scope.
QString keysAsHtml();

/// All of the table as the content of Documentation/keys.md.
QString keysAsMarkdown();
}

#endif

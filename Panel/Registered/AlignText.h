// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the panel says about an alignment, in words.
#ifndef BrainShift_AlignText_h
#define BrainShift_AlignText_h

#include <QString>

namespace brainshift
{
struct AlignFigures;

/// How far it is: lines searched, mutual information, and how far the reference was moved (mm,
/// degrees).
QString alignProgress(const AlignFigures& figures);

/// What was reached: `ended` begins the text, for example "Finished".
QString alignResult(const QString& ended, const AlignFigures& figures);

/// Warns of a reference that was moved farther than is tested. Empty if there is nothing to warn
/// of.
QString alignWarning(const AlignFigures& figures);
}

#endif

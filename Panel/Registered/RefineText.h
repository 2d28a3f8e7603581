// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the panel says about a refinement, in words.
#ifndef BrainShift_RefineText_h
#define BrainShift_RefineText_h

#include <QString>

namespace brainshift
{
struct RefineFigures;

/// How far it is: step, change (mm) and the share of the volume that is compared.
QString refineProgress(const RefineFigures& figures);

/// What was reached: `ended` begins the text, for example "Finished".
QString refineResult(const QString& ended, const RefineFigures& figures);

/// Warns of a result that got worse by its own measure, folds tissue, or was compared in less than
/// a quarter of the volume. Empty if there is nothing to warn of.
QString refineWarning(const RefineFigures& figures);
}

#endif

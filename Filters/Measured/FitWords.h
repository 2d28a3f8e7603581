// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file
 * @brief What a user must know about a fit that has a result.
 */
#ifndef BrainShift_FitWords_h
#define BrainShift_FitWords_h

#include "Filters/Fit/FittedLattice.h"

#include <string>

namespace brainshift
{
/**
 * Sentences with full stops between them; empty if nothing is to be said.
 *
 * @param fitted         a fit with a result
 * @param unmatched      names of landmarks without a partner; empty if there are none
 * @param isInCavity     whether all traced points lie in the cavity
 */
std::string wordsOnFit(const FittedLattice& fitted, const std::string& unmatched, bool isInCavity);
}

#endif

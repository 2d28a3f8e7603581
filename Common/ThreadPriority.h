// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which threads the processor prefers.
#ifndef BrainShift_ThreadPriority_h
#define BrainShift_ThreadPriority_h

#include "Common/Export.h"

namespace brainshift
{
/** From now on the calling thread leaves the cores to others, where these are few. */
BRAINSHIFT_COMMON_EXPORT void giveWayToOtherThreads();
}

#endif

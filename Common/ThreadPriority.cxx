// SPDX-License-Identifier: BSD-3-Clause
#include "Common/ThreadPriority.h"

#if defined(_WIN32)
#include <windows.h>
#elif defined(__linux__)
#include <sys/resource.h>
#endif

namespace brainshift
{
void giveWayToOtherThreads()
{
#if defined(_WIN32)
  SetThreadPriority(GetCurrentThread(), THREAD_PRIORITY_BELOW_NORMAL);
#elif defined(__linux__)
  constexpr int Nicer = 10;
  setpriority(PRIO_PROCESS, 0, Nicer); // of the calling thread alone; on other systems of them all
#endif
}
}

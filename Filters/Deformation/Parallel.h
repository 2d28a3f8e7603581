// SPDX-License-Identifier: BSD-3-Clause
// Loops over all processor cores. Debian's ParaView 5.13 leaves vtkSMPTools on one core unless the
// user names a back end (VTK_SMP_BACKEND_IN_USE); our own loops take threads there all the same.
// VTK_SMP_MAX_THREADS limits them everywhere.
#ifndef BrainShift_Parallel_h
#define BrainShift_Parallel_h

#include "vtkSMP.h"
#include "vtkSMPTools.h"
#include "vtkType.h"

#include <cstdlib>
#include <cstring>

namespace brainshift
{
// Whether vtkSMPTools is on one core because nobody chose otherwise.
inline bool leftSequential()
{
#if VTK_SMP_DEFAULT_IMPLEMENTATION_SEQUENTIAL && VTK_SMP_ENABLE_STDTHREAD
  return !std::getenv("VTK_SMP_BACKEND_IN_USE") &&
    std::strcmp(vtkSMPTools::GetBackend(), "Sequential") == 0;
#else
  return false;
#endif
}

// Calls body(begin, end) for pieces that together are first to last, on many threads. Pieces must
// not depend on each other; then the result is that of body(first, last), bit for bit. Up to
// `grain` steps are not worth a thread: they run at once, as does a loop within a piece.
template <typename Body>
void parallelFor(vtkIdType first, vtkIdType last, vtkIdType grain, const Body& body)
{
  if (last - first <= grain)
  {
    body(first, last);
  }
  else if (leftSequential())
  {
    // ParaView runs pipelines and draws on one thread, so nobody else sees the back end change.
    vtkSMPTools::LocalScope(
      vtkSMPTools::Config(std::string("STDThread")), [&] { vtkSMPTools::For(first, last, body); });
  }
  else
  {
    vtkSMPTools::For(first, last, body);
  }
}
}

#endif

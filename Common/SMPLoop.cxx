// SPDX-License-Identifier: BSD-3-Clause
// The parallel loop on vtkSMPTools. VTK_SMP_BACKEND_IN_USE names the back end, as it does for VTK's
// own filters, and VTK_SMP_MAX_THREADS limits the threads. Debian's ParaView 5.13 leaves
// vtkSMPTools on one core unless the user names a back end. Our loops take threads there all the
// same.
#include "Common/PieceRunner.h"

#include "vtkSMP.h"
#include "vtkSMPTools.h"

#include <cstdlib>
#include <cstring>
#include <string>

namespace brainshift
{
namespace
{
thread_local bool isAlone = false;

// Whether vtkSMPTools is on one core because the user chose no back end.
bool leftSequential()
{
#if VTK_SMP_DEFAULT_IMPLEMENTATION_SEQUENTIAL && VTK_SMP_ENABLE_STDTHREAD
  return !std::getenv("VTK_SMP_BACKEND_IN_USE") &&
    std::strcmp(vtkSMPTools::GetBackend(), "Sequential") == 0;
#else
  return false;
#endif
}
}

void keepLoopsOnThisThread()
{
  isAlone = true;
}

void loopInPieces(std::int64_t first, std::int64_t last, const LoopBody& body)
{
  if (isAlone)
  {
    body(first, last);
    return;
  }
  PieceRunner runner(body);
  const LoopBody piece = [&](std::int64_t begin, std::int64_t end) { runner.run(begin, end); };
  if (leftSequential())
  {
    // ParaView runs pipelines and draws on one thread, so no other code sees the back end change.
    vtkSMPTools::LocalScope(
      vtkSMPTools::Config(std::string("STDThread")), [&] { vtkSMPTools::For(first, last, piece); });
  }
  else
  {
    vtkSMPTools::For(first, last, piece);
  }
  runner.rethrow();
}
}

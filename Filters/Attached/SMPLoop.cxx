// SPDX-License-Identifier: BSD-3-Clause
#include "Filters/Attached/SMPLoop.h"

#include "vtkSMP.h"
#include "vtkSMPTools.h"

#include <cstdlib>
#include <cstring>
#include <string>

namespace brainshift
{
namespace
{
// Whether vtkSMPTools is on one core because nobody chose otherwise.
bool leftSequential()
{
#if VTK_SMP_DEFAULT_IMPLEMENTATION_SEQUENTIAL && VTK_SMP_ENABLE_STDTHREAD
  return !std::getenv("VTK_SMP_BACKEND_IN_USE") &&
    std::strcmp(vtkSMPTools::GetBackend(), "Sequential") == 0;
#else
  return false;
#endif
}

// Static, so that it holds before the first filter runs.
const struct Chosen
{
#ifdef BRAINSHIFT_OWN_THREADS
  // The thread sanitizer does not see how the threads of a VTK that it was not built for wait.
  Chosen() { setLoop(loopOnThreads); }
#else
  Chosen() { setLoop(loopWithSMPTools); }
#endif
} chosen;
}

void loopWithSMPTools(std::int64_t first, std::int64_t last, const LoopBody& body)
{
  PieceRunner runner(body);
  const LoopBody piece = [&](std::int64_t begin, std::int64_t end) { runner.run(begin, end); };
  if (leftSequential())
  {
    // ParaView runs pipelines and draws on one thread, so nobody else sees the back end change.
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

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The inputs of filters that exchange something between MPI ranks.
///
/// Where an input fails, VTK does not run the filter. If it fails on one rank alone, the others
/// would wait in the filter for that rank for ever.
#ifndef BrainShift_RankInputs_h
#define BrainShift_RankInputs_h

#include "vtkBrainShiftCommonModule.h" // for the export macro

class vtkAlgorithm;
class vtkInformation;

namespace brainshift
{
/**
 * Whether all inputs of a filter work on all MPI ranks, the same on all. If not, the first rank
 * reports an error of the filter. Call it in ModifyRequest, which VTK calls on each rank before it
 * passes a request on to the inputs. One process always goes on.
 */
VTKBRAINSHIFTCOMMON_EXPORT bool inputsWorkOnAllRanks(
  vtkAlgorithm* filter, vtkInformation* request, int when);
}

/** Defines ModifyRequest of a filter, which then fails on all ranks or on none. The header declares
 * it. */
#define brainshiftInputsOfAllRanksMacro(name)                                                      \
  int name::ModifyRequest(vtkInformation* request, int when)                                       \
  {                                                                                                \
    return brainshift::guarded(this, 0, [&] {                                                      \
      const bool goes = brainshift::inputsWorkOnAllRanks(this, request, when);                     \
      return goes ? this->Superclass::ModifyRequest(request, when) : 0;                            \
    });                                                                                            \
  }

#endif

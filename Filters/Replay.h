// SPDX-License-Identifier: BSD-3-Clause
// Turns the list of strokes into control-point displacements, doing again only what changed.
#ifndef BrainShift_Replay_h
#define BrainShift_Replay_h

#include "Lattice.h"
#include "Stroke.h"

#include <vector>

namespace brainshift
{
class VTKBRAINSHIFTFILTERS_EXPORT Replay
{
public:
  // The base lattice after `strokes`, in order. If only the last stroke differs from the previous
  // call, or one was added, one stroke is applied; otherwise all are.
  const Lattice& run(const Lattice& base, const std::vector<Stroke>& strokes);

  // Strokes applied by the last run.
  int applied() const { return this->Applied; }

private:
  bool startsAsBefore(const Lattice& base, const std::vector<Stroke>& strokes) const;

  Lattice Base;
  std::vector<Stroke> Strokes;
  Lattice BeforeLast; // after all strokes but the last
  Lattice Result;     // after all of them
  int Applied = 0;
};
}

#endif

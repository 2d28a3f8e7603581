// SPDX-License-Identifier: BSD-3-Clause
// Turns the list of strokes into control-point displacements, doing again only what changed. With
// the fold guard each stroke, in order, is applied as far as nothing folds.
#ifndef BrainShift_Replay_h
#define BrainShift_Replay_h

#include "Filters/Deformation/FoldGuard.h"
#include "Filters/Deformation/Lattice.h"
#include "Filters/Deformation/Stroke.h"

#include <vector>

namespace brainshift
{
struct Guarding
{
  bool on = false;
  int samples = 4; // nodes between two control points of the field that is drawn

  bool operator==(const Guarding& other) const
  {
    return this->on == other.on && (!this->on || this->samples == other.samples);
  }
};

class VTKBRAINSHIFTFILTERS_EXPORT Replay
{
public:
  // The base lattice after `strokes`, in order. If only the last stroke differs from the previous
  // call, or one was added, one stroke is applied; otherwise all are.
  const Lattice& run(
    const Lattice& base, const std::vector<Stroke>& strokes, const Guarding& guarding = {});

  // Strokes applied by the last run.
  int applied() const { return this->Applied; }

  // How much of each stroke was applied, 0 to 1; 1: all of it, or a disabled stroke.
  const std::vector<double>& shares() const { return this->Shares; }

  // Cells of the base lattice that the guard leaves alone, since they fold by themselves.
  int foldedCells() const { return this->Guarded.on ? this->Guard.foldedCells() : 0; }

private:
  bool startsAsBefore(
    const Lattice& base, const std::vector<Stroke>& strokes, const Guarding& guarding) const;
  double apply(const Stroke& stroke);

  Lattice Base;
  Guarding Guarded;
  FoldGuard Guard;
  std::vector<Stroke> Strokes;
  std::vector<double> Shares;
  Lattice BeforeLast; // after all strokes but the last
  Lattice Result;     // after all of them
  int Applied = 0;
};
}

#endif

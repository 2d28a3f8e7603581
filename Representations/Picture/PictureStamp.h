// SPDX-License-Identifier: BSD-3-Clause
// Knows what of a picture would come out as it did the last time. While a tool hovers, only its
// outline over the picture changes; while it bends, only the tissue it moves.
#ifndef BrainShift_PictureStamp_h
#define BrainShift_PictureStamp_h

#include <vector>

class vtkRenderer;
class vtkVolume;

namespace brainshift
{
struct Counters;
struct RayCastScene;

class PictureStamp
{
public:
  enum Change
  {
    Nothing,
    Bending,  // the offset field alone has other values
    Reaching, // the same, and tissue can reach farther or less far: rays begin elsewhere
    Anything
  };
  // What that a picture depends on differs from the last call; what lies in front of or behind the
  // volume counts, too, but not traced points, which are drawn over it.
  // `settingsTime`: when the mapper was set up otherwise.
  Change change(vtkRenderer* renderer, vtkVolume* volume, unsigned long long settingsTime,
    const RayCastScene& scene, const Counters& counters);

  // To the next picture anything has changed.
  void forget() { this->Last.clear(); }

private:
  std::vector<double> Last; // all but what bending changes
  std::vector<double> LastBending;
  std::vector<double> LastSpace;
};
}

#endif

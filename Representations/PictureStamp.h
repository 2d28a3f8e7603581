// SPDX-License-Identifier: BSD-3-Clause
// Knows whether a picture would come out as the last one did. While a tool hovers, only its outline
// over the picture changes.
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
  // True if all that the picture depends on is as it was at the last call; what lies in front of or
  // behind the volume counts, too, but not traced points, which are drawn over it.
  bool repeats(
    vtkRenderer* renderer, vtkVolume* volume, const RayCastScene& scene, const Counters& counters);

  // The next picture repeats none.
  void forget() { this->Last.clear(); }

private:
  std::vector<double> Last;
};
}

#endif

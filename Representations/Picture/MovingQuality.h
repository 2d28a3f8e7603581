// SPDX-License-Identifier: BSD-3-Clause
// What is left out while the camera or a stroke moves, so that pictures come fast enough for a
// hand.
#ifndef BrainShift_MovingQuality_h
#define BrainShift_MovingQuality_h

#include "vtkBrainShiftRepresentationsModule.h" // for the export macro

namespace brainshift
{
struct MovingQuality
{
  int imageScale = 1;    // screen pixels a side for one pixel of the image
  int stepDoublings = 0; // how often the step along the ray is doubled

  bool isFull() const { return this->imageScale == 1 && this->stepDoublings == 0; }
};

constexpr int LargestImageScale = 4;
constexpr int MostStepDoublings = 2;

// Whether a window that wants so many frames a second is being moved; still pictures ask for far
// fewer.
bool isMoving(double rate);

// `fullSeconds`: what an image with all pixels and the usual step takes; `allowedSeconds`: what it
// may take, above 0. Fewer pixels first: longer steps only where these do not do.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT MovingQuality movingQuality(
  double fullSeconds, double allowedSeconds);

// What an image may take in a window that wants `rate` frames a second, of which the window itself
// takes `windowSeconds` each, after `spentSeconds` went into preparing it: a stroke needs that, a
// camera move does not.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT double allowedSeconds(
  double rate, double windowSeconds, double spentSeconds);

// How long a window and its application take from one moving picture to the next, which no mapper
// sees: smoothing of edges, copies, news of new data.
class VTKBRAINSHIFTREPRESENTATIONS_EXPORT WindowPace
{
public:
  void beginPicture();
  void endPicture();
  double spentSeconds() const; // since the picture's beginning
  double windowSeconds() const { return this->Window; }

  // What one pause between pictures tells. `processor`: seconds of all processors, that a hand
  // which rests does not take.
  void learn(double clock, double processor);

private:
  struct Time
  {
    double clock = 0.0;
    double processor = 0.0;
  };
  static Time now();

  Time Begin;
  Time End;
  double Window = 0.03; // until a picture follows another
};
}

#endif

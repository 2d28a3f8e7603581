// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Lower quality while the camera or a stroke moves, so that pictures come fast enough for a hand.
#ifndef BrainShift_MovingQuality_h
#define BrainShift_MovingQuality_h

#include "Representations/Gpu/ShaderSource.h"

namespace brainshift
{
/// The quality of one picture.
struct MovingQuality
{
  int imageScale = 1;    ///< Screen pixels a side for one pixel of the image.
  int stepDoublings = 0; ///< How often the step along the ray is doubled.

  bool isFull() const { return this->imageScale == 1 && this->stepDoublings == 0; }
};

constexpr int LargestImageScale = 4;

/// Whether a window that wants `rate` frames a second is being moved. For still pictures it wants
/// far fewer.
bool isMoving(double rate);

/// The best quality that is fast enough. `fullSeconds`: the time of an image with all pixels and
/// the usual step. `allowedSeconds`: the time it may take, above 0. Steps become longer only if the
/// fewest pixels are still too slow.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT MovingQuality movingQuality(
  double fullSeconds, double allowedSeconds);

/// The time that an image may take in a window that wants `rate` frames a second. `windowSeconds`:
/// what the window itself takes for each frame. `spentSeconds`: what the preparation of this one
/// took, which a stroke needs and a camera move does not.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT double allowedSeconds(
  double rate, double windowSeconds, double spentSeconds);

/// Learns how long a window and its application take from one moving picture to the next. No mapper
/// sees that time: smoothing of edges, copies, the delivery of new data.
class VTKBRAINSHIFTREPRESENTATIONS_EXPORT WindowPace
{
public:
  void beginPicture();
  void endPicture();

  /// Seconds since the beginning of the picture.
  double spentSeconds() const;

  /// Seconds that the window itself takes.
  double windowSeconds() const { return this->Window; }

  /// Learns from one pause between pictures. `clock`: its seconds. `processor`: the seconds that
  /// all processors worked in it; a resting hand makes them none.
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

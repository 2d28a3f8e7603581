// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The picture that is being saved: its tiles, eyes and volumes share one time to wait, and one
/// warning.
#ifndef BrainShift_PictureCapture_h
#define BrainShift_PictureCapture_h

#include "Representations/Bricks/StreamedBricks.h"

#include "vtkWeakPointer.h"

#include <set>
#include <tuple>

class vtkOpenGLRenderWindow;

namespace brainshift
{
/// ParaView tells that a picture is to be saved, but not when the next one begins: it begins when
/// what was drawn comes again.
class PictureCapture
{
public:
  static constexpr std::chrono::seconds LongestWait{ 60 };

  /// Of this process.
  static PictureCapture& current();

  /// `device` draws an eye of a tile of it.
  void join(vtkOpenGLRenderWindow* window, const void* device, bool isLeftEye);

  /// A picture is drawn that is not saved.
  void end();

  /// Nothing waits longer.
  const StreamedBricks::Clock::time_point& deadline() const { return this->Deadline; }

  /// Warns once for this picture if these bricks are not all that it shows.
  void reportIfCoarse(GpuTask& gpu, const StreamedBricks& bricks);

private:
  using Part = std::tuple<const void*, bool, double, double>; // device, eye, corner of the tile

  vtkWeakPointer<vtkOpenGLRenderWindow> Window; // null: none is saved
  std::set<Part> Drawn;
  StreamedBricks::Clock::time_point Deadline;
  bool Warned = false;
};
}

#endif

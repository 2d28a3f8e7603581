// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The window and the level of slices under a drag of the mouse. The window is the length of the
/// range of values between black and white, the level its middle. Displays with the same colour
/// map follow.
#ifndef BrainShift_GreyValues_h
#define BrainShift_GreyValues_h

#include <vtkSmartPointer.h>

#include <vector>

class vtkSMProxy;

namespace brainshift
{
class GreyValues
{
public:
  /// Takes the colour map of a display. False if it has none that covers a range of values.
  bool begin(vtkSMProxy* display, const int pixel[2]);
  /// To the right the window becomes wider, upwards the level becomes higher. Nothing is drawn.
  /// `scale`: see Common/ScreenScale.h.
  void dragTo(const int pixel[2], double scale);
  /// Makes one step to undo of the whole drag. From now on ParaView leaves the range as it is when
  /// a filter is applied.
  void end();

private:
  void set(const std::vector<double>& points);

  vtkSmartPointer<vtkSMProxy> Colors;
  std::vector<double> Before; ///< Points of the colour map: value, red, green, blue.
  std::vector<double> Now;
  int Start[2] = { 0, 0 };
};
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Text in a view that follows the resolution of the window. VTK's actor keeps the letters of the
/// last picture, so ParaView's screenshots, which change resolution and tiles, showed them small.
#ifndef BrainShift_WindowText_h
#define BrainShift_WindowText_h

#include "vtkTextActor.h"

#include <glm/glm.hpp>

#include <functional>
#include <string>

namespace brainshift
{
/// Points that a letter at an edge of a view needs (OrientationMarks), with some space.
constexpr double LetterPoints = 26.0;

class WindowText : public vtkTextActor
{
public:
  static WindowText* New();
  vtkTypeMacro(WindowText, vtkTextActor);

  int RenderOpaqueGeometry(vtkViewport* viewport) override;

  /// The pixels that there are for the text, from those of the view and of a point (1/72 inch). The
  /// letters shrink to fit, as far as they can be read. Null (default): they do not shrink.
  std::function<glm::dvec2(const glm::dvec2& view, double point)> Room;

  /// The size of letters (points), up to `most`, at which a text of this extent fits into a room.
  static int FittingSize(int most, const glm::dvec2& extent, const glm::dvec2& room);

protected:
  WindowText() = default;
  ~WindowText() override = default;

private:
  void Fit(vtkViewport* viewport);

  int Size = 0; // of letters, points, before they shrink
  glm::dvec2 Fitted{ 0.0 };
  std::string FittedText;
  int Dpi = 0; // dots per inch, and tiles a side, of the last picture
  int Tiles[2] = { 1, 1 };
};

/// Places a legend at the left, below the letter of the upper edge and the name of a slice. Returns
/// its room, above the letter of the left edge and, if there is a legend at the right, beside that.
glm::dvec2 placeLegend(
  vtkTextActor* legend, const glm::dvec2& view, double point, bool hasOtherAtRight);
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   OrientationMarks
 * @brief   the letters R L A P S I at the edges of a view
 *
 * A letter names the side of the patient towards which its edge lies: right, left, anterior,
 * posterior, superior or inferior. The letters follow from the camera of each picture, so that they
 * are right however the view is turned. A view that looks along no axis, within about 25 degrees,
 * shows none.
 */
#ifndef BrainShift_OrientationMarks_h
#define BrainShift_OrientationMarks_h

#include "vtkBrainShiftRepresentationsModule.h" // for the export macro

#include "vtkNew.h"
#include "vtkProp.h"

#include <array>
#include <string>

class vtkTextActor;

namespace brainshift
{
/// Letters of the right, left, upper and lower edge of a view, from the directions (world) that
/// point right and up in it. Empty if a direction follows no axis.
VTKBRAINSHIFTREPRESENTATIONS_EXPORT std::array<std::string, 4> edgeLetters(
  const double right[3], const double up[3]);

class OrientationMarks : public vtkProp
{
public:
  static OrientationMarks* New();
  vtkTypeMacro(OrientationMarks, vtkProp);

  int RenderOpaqueGeometry(vtkViewport* viewport) override;
  int RenderOverlay(vtkViewport* viewport) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

protected:
  OrientationMarks();
  ~OrientationMarks() override;

private:
  std::array<vtkNew<vtkTextActor>, 4> Letters;
};
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   OrientationMarks
 * @brief   the letters R L A P S I at the edges of a view, and the name of its plane
 *
 * A letter names the side of the patient at its edge: right, left, anterior,
 * posterior, superior or inferior. The letters follow from the camera of each picture and from the
 * transform of the volume, so that they are right in any rotation of both. From 5 degrees on, the
 * angle between the edge's direction and the letter's is written beside it ("R 12°"). A view that
 * looks along no axis of the patient or of the grid, within about 25 degrees, shows none. If the
 * meaning of the axes for the patient is unknown, x, y and z replace the letters, and a warning is
 * shown.
 *
 * The upper left corner shows the name of the plane that the view looks across, in the plane's
 * colour, with the angle between the plane and the patient's.
 */
#ifndef BrainShift_OrientationMarks_h
#define BrainShift_OrientationMarks_h

#include "vtkBrainShiftRepresentationsModule.h" // for the export macro

#include "Common/WorldAxes.h"

#include "vtkNew.h"
#include "vtkProp.h"
#include "vtkWeakPointer.h"

#include <array>
#include <string>
#include <vector>

class vtkProp3D;
class vtkTextActor;

namespace brainshift
{
class WindowText;

/// Letters of the right, left, upper and lower edge of a view.
///
/// @param right   cosines between the direction to the right in the view and the volume's x, y, z
/// @param up      the same for the direction upwards
/// @param axes    what x, y and z mean for the patient
/// @param always  whether there are letters at any angle
/// @return        letters of the nearest axes, with the angle from 5 degrees on. Empty strings if
///                a direction is more than about 25 degrees from all axes, unless `always`
VTKBRAINSHIFTREPRESENTATIONS_EXPORT std::array<std::string, 4> edgeLetters(
  const double right[3], const double up[3], WorldAxes axes, bool always);

class OrientationMarks : public vtkProp
{
public:
  static OrientationMarks* New();
  vtkTypeMacro(OrientationMarks, vtkProp);

  int RenderOpaqueGeometry(vtkViewport* viewport) override;
  int RenderOverlay(vtkViewport* viewport) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;

  /// What the axes of the volume mean for the patient.
  WorldAxes Axes = WorldAxes::Unknown;

  /// Whether the letters are drawn. Default true.
  bool ShowLetters = true;

  /// Directions of the grid's axes, where the transform of the volume does not turn them. Default:
  /// those of the world.
  std::array<std::array<double, 3>, 3> GridAxes{ { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } };

  /// Whether a view that looks across the sagittal, the coronal or the axial plane is named for it.
  /// Default false.
  std::array<bool, 3> NamedPlanes{};

  /// The volume, whose transform turns the axes. Null: they are those of the world.
  vtkWeakPointer<vtkProp3D> Volume;

protected:
  OrientationMarks();
  ~OrientationMarks() override;

private:
  // Cosines between a direction (world) and the volume's axes.
  std::array<double, 3> AlongAxes(const double direction[3]) const;

  // Finds the texts for a camera.
  void Write(vtkViewport* viewport);

  // The axis of the grid that the view looks along; -1: none. `back`: cosines between the direction
  // to the eye and the volume's axes.
  int GridAxisAlong(const std::array<double, 3>& back) const;

  void WriteName(const std::array<double, 3>& back);

  // Those of all texts that have something to say.
  std::vector<vtkTextActor*> Texts() const;

  std::array<vtkNew<WindowText>, 4> Letters;
  vtkNew<WindowText> Name; // of the plane
  vtkNew<WindowText> Warning;
};
}

#endif

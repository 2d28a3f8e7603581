// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The mouse in a 2D view of Deformed Slices. The table of commands lists the gestures under
/// Scope::Slices.
#ifndef BrainShift_SliceMouse_h
#define BrainShift_SliceMouse_h

#include "Interaction/Commands/Commands.h"
#include "Interaction/Views/GreyValues.h"

#include <QTimer>

#include <vtkWeakPointer.h>

class pqRenderView;
class vtkCamera;
class vtkObject;
class vtkRenderWindowInteractor;
class vtkSMProperty;
class vtkSMProxy;

namespace brainshift
{
/// Brings Deformed Slices to a position (mm), and those of the same volume in other views to the
/// same tissue. It is no step to undo.
void bringSlicesTo(vtkSMProxy* display, const double position[3]);

/// Belongs to one view and ends with it.
class SliceMouse : public QObject
{
  Q_OBJECT

public:
  /// Makes one for every render view, also for views that come later, until `context` ends.
  static void watchViews(QObject* context);

  /// The object of a view. Null if the view has none.
  static SliceMouse* of(pqRenderView* view);

  explicit SliceMouse(pqRenderView* view);
  ~SliceMouse() override;

  /// Steps through the slices that face the view, by voxels towards greater coordinates. False if
  /// no slice faces the view.
  bool step(int voxels);

private:
  /// A slice that faces the view.
  struct Facing
  {
    vtkSMProxy* display = nullptr; ///< Null: there is none.
    bool isMoved = false;          ///< It has a transform: the cursor is elsewhere in its volume.
    int plane = 0;                 ///< 0 sagittal, 1 coronal, 2 axial.
    double normals[9] = {};        ///< Of all three, see vtkDeformedSlicesMapper.
    double voxelSteps[3] = {};     ///< mm.
  };
  Facing facingSlice() const;

  Command commandOf(Mouse mouse) const; ///< With the modifiers held now.

  /// Observer of the interactor. True: the event ends here.
  bool onWheel(vtkObject* interactor, unsigned long event, void* data);
  /// Observer of the interactor. True: the event ends here.
  bool onButton(vtkObject* interactor, unsigned long event, void* data);
  /// Observer of the interactor. True: the event ends here.
  bool onRightButton(vtkObject* interactor, unsigned long event, void* data);
  /// Observer of the interactor. True: the event ends here.
  bool onDoubleClick(vtkObject* interactor, unsigned long event, void* data);
  /// Observer of the interactor. True: the event ends here.
  bool onMove(vtkObject* interactor, unsigned long event, void* data);

  /// Finds the position under the cursor in the slice (mm).
  void findCursor(const Facing& slice, double world[3]) const;
  void bringToCursor(const Facing& slice);
  bool isOnWipe(const Facing& slice) const;
  void bringWipeToCursor(const Facing& slice);

  pqRenderView* View;
  vtkWeakPointer<vtkRenderWindowInteractor> Interactor;
  std::vector<unsigned long> Observers;

  enum class Drag
  {
    Nothing,
    Planes,
    Wipe,
    GreyValues,
  };
  Drag Dragging = Drag::Nothing;
  GreyValues Greys; ///< Under the drag.

  /// Observer of the camera.
  void noticeZoom();
  /// Observer of the view's property, which a link changes. Gives the camera its zoom at once: the
  /// next picture would give the property, and all that are linked to it, that of the camera.
  void noticeAskedZoom();
  /// Reports the zoom to ParaView, so that linked views follow, and draws a zoom that came from
  /// another view.
  void sendZoom();
  vtkWeakPointer<vtkCamera> Camera;
  unsigned long CameraObserver = 0;
  vtkWeakPointer<vtkSMProperty> AskedZoom;
  unsigned long AskedObserver = 0;
  double Zoom = 0.0;    ///< Half of the height of the view (mm) when it was sent last.
  bool Follows = false; ///< Another view was zoomed, and this one by its link.
  QTimer Sharing;
};
}

#endif

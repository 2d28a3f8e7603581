// SPDX-License-Identifier: BSD-3-Clause
// The mouse in a 2D view of Deformed Slices: the wheel goes through the slices a voxel at a time,
// dragging with Shift brings the other planes to the cursor, dragging the line of a Wipe moves it.
// With Ctrl the wheel zooms as elsewhere.
#ifndef BrainShift_SliceMouse_h
#define BrainShift_SliceMouse_h

#include <QObject>

#include <vtkWeakPointer.h>

#include <vector>

class pqRenderView;
class vtkObject;
class vtkRenderWindowInteractor;
class vtkSMProxy;

// Lives and ends with its view.
class SliceMouse : public QObject
{
  Q_OBJECT

public:
  // One for every render view there is or will be, until `context` ends.
  static void watchViews(QObject* context);

  // The one of a view; null if it has none.
  static SliceMouse* of(pqRenderView* view);

  explicit SliceMouse(pqRenderView* view);
  ~SliceMouse() override;

  // Goes through the slices that face the view, by voxels towards greater coordinates. False if
  // there are none.
  bool step(int voxels);

private:
  // A slice that faces the view.
  struct Facing
  {
    vtkSMProxy* display = nullptr; // null: none
    int plane = 0;                 // 0 sagittal, 1 coronal, 2 axial
    double normals[9] = {};        // of all three, see vtkDeformedSlicesMapper
    double voxelSteps[3] = {};     // mm
  };
  Facing facingSlice() const;

  // Observers of the interactor; true: nobody else is to hear of the event.
  bool onWheel(vtkObject* interactor, unsigned long event, void* data);
  bool onButton(vtkObject* interactor, unsigned long event, void* data);
  bool onMove(vtkObject* interactor, unsigned long event, void* data);

  // In the slice, mm.
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
  };
  Drag Dragging = Drag::Nothing;
};

#endif

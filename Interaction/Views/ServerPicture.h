// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The last picture that a server drew, over which the outline of a tool moves before the next.
///
/// Where a server draws, the client draws the outline alone, over what the server sent. A step of a
/// drag waits for the server's next picture, two round trips. Until then the outline is drawn over
/// the last one.
#ifndef BrainShift_ServerPicture_h
#define BrainShift_ServerPicture_h

#include <vtkCallbackCommand.h>
#include <vtkNew.h>
#include <vtkType.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWeakPointer.h>

#include <QObject>

#include <array>

class pqRenderView;
class pqView;
class vtkRenderer;

namespace brainshift
{
class ServerPicture : public QObject
{
  Q_OBJECT

public:
  /// Keeps the pictures of a view, whose child it is, where a server may draw them.
  explicit ServerPicture(pqRenderView* view);
  ~ServerPicture() override;

  /// Draws at once what the client draws in a view over the last picture. Nothing if none is kept,
  /// or if the camera or the size is another since.
  static void drawOver(pqView* view);

private:
  struct Seen
  {
    std::array<int, 2> size{ 0, 0 };
    vtkMTimeType camera = 0; // unique among all objects

    bool operator==(const Seen& o) const { return size == o.size && camera == o.camera; }
  };

  Seen seen() const;
  void keep();
  void draw();

  vtkWeakPointer<vtkRenderer> Renderer; ///< Of the view; without outlines.
  vtkNew<vtkCallbackCommand> Drawn;
  vtkNew<vtkUnsignedCharArray> Pixels; ///< RGB, from below.
  Seen Kept;
};
}

#endif

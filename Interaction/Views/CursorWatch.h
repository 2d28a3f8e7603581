// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The cursor over render views: which view it is over, and what is new under it.
#ifndef BrainShift_CursorWatch_h
#define BrainShift_CursorWatch_h

#include <vtkEventQtSlotConnect.h>
#include <vtkNew.h>

#include <QHash>
#include <QObject>
#include <QPointer>
#include <QTimer>

class pqPipelineSource;
class pqRenderView;
class pqView;
class vtkObject;

namespace brainshift
{
/// Signals that the picture under a resting cursor has changed: after undo, for example.
class RestingCursor : public QObject
{
  Q_OBJECT

public:
  explicit RestingCursor(QObject* parent);

  /// The Free-Form Deformation and the view to watch from now on. Null: none.
  void follow(pqPipelineSource* deformation, pqRenderView* view);

  void signalSoon() { this->Soon.start(); } ///< Something is new now.
  void signalAfterPicture()
  {
    this->Outdated = true;
  } ///< The view's next picture shows something new.

Q_SIGNALS:
  /// From the event loop. The view's last picture shows what is new.
  void sees();

private:
  QPointer<pqPipelineSource> Deformation;
  QPointer<pqRenderView> View;
  QTimer Soon;
  bool Outdated = false;
};

/// Knows which render view the cursor is over. It receives events of the mouse before anything in
/// the view does.
class CursorWatch : public QObject
{
  Q_OBJECT

public:
  explicit CursorWatch(QObject* parent);

  /// The view under the cursor; null if there is none.
  pqRenderView* view() const;

Q_SIGNALS:
  /// The cursor moved within a view, or came to it.
  void moved(pqRenderView* view);
  /// The cursor left the view under it.
  void left();

private Q_SLOTS:
  void enter(vtkObject* interactor);
  void leave(vtkObject* interactor);

private:
  void watch(pqView* view);

  vtkNew<vtkEventQtSlotConnect> Connector;
  QHash<vtkObject*, QPointer<pqRenderView>> Views; ///< By interactor.
  QPointer<pqRenderView> Over;
};
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Knows which render view the cursor is over. It hears of the mouse before anything in the view
/// does.
#ifndef BrainShift_CursorWatch_h
#define BrainShift_CursorWatch_h

#include <QHash>
#include <QObject>
#include <QPointer>

#include <vtkEventQtSlotConnect.h>
#include <vtkNew.h>

class pqRenderView;
class pqView;
class vtkObject;

namespace brainshift
{
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

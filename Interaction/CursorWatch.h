// SPDX-License-Identifier: BSD-3-Clause
// Tells which render view the cursor is over, before anything in the view hears of the mouse.
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

class CursorWatch : public QObject
{
  Q_OBJECT

public:
  explicit CursorWatch(QObject* parent);

  // Null: over none.
  pqRenderView* view() const;

Q_SIGNALS:
  void moved(pqRenderView* view);

private Q_SLOTS:
  void enter(vtkObject* interactor);
  void leave(vtkObject* interactor);

private:
  void watch(pqView* view);

  vtkNew<vtkEventQtSlotConnect> Connector;
  QHash<vtkObject*, QPointer<pqRenderView>> Views; // by interactor
  QPointer<pqRenderView> Over;
};

#endif

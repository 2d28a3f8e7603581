// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A lattice widget that is in a view as long as this object lives.
#ifndef BrainShift_WidgetInView_h
#define BrainShift_WidgetInView_h

#include "Interaction/Views/ServerPicture.h"

#include <vtkLatticeWidget.h>
#include <vtkSmartPointer.h>

#include <QPointer>

class pqRenderView;
class vtkLatticeRepresentation;
class vtkSMProxy;

namespace brainshift
{
class WidgetInView
{
public:
  WidgetInView(pqRenderView* view, vtkLatticeWidget::HandlerType handler);
  ~WidgetInView();

  vtkLatticeRepresentation* representation() const;
  vtkLatticeWidget* widget() const;

private:
  void show(bool on);

  QPointer<pqRenderView> View;
  QPointer<ServerPicture> Picture;
  vtkSmartPointer<vtkSMProxy> Proxy;
};
}

#endif

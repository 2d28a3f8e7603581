// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Properties/AlignWidget.h"

#include "Interaction/Commands/Application.h"
#include "Interaction/Workarounds/Docks.h"
#include "Panel/Registered/AlignPane.h"

#include <pqPipelineSource.h>

#include <vtkSMProxy.h>

#include <QVBoxLayout>

namespace brainshift
{
AlignWidget::AlignWidget(vtkSMProxy* proxy, vtkSMProperty* /*property*/, QWidget* parent)
  : pqPropertyWidget(proxy, parent)
{
  this->setShowLabel(false);
  auto column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  pqServerManagerModel* model = serverManagerModel();
  if (auto source = model->findItem<pqPipelineSource*>(proxy))
  {
    column->addWidget(new AlignPane(source, this));
  }
  new RoomyDock(this);
}
}

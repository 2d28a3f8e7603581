// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Views/FourViewsActions.h"

#include <pqActiveObjects.h>
#include <pqPipelineSource.h>
#include <pqUndoStack.h>

#include <vtkPVDataInformation.h>
#include <vtkPythonInterpreter.h>
#include <vtkSMSourceProxy.h>

#include <QAction>
#include <QIcon>

namespace brainshift
{
namespace
{
bool isVolume(pqPipelineSource* source)
{
  auto proxy = source ? vtkSMSourceProxy::SafeDownCast(source->getProxy()) : nullptr;
  return proxy && proxy->GetOutputPortsCreated() &&
    proxy->GetDataInformation(0)->DataSetTypeIsA("vtkImageData");
}
}

FourViewsActions::FourViewsActions(QObject* parent)
  : QActionGroup(parent)
{
  QAction* action = this->addAction(tr("Four Views"));
  action->setIcon(QIcon(":/BrainShift/four-views.svg"));
  action->setObjectName("actionBrainShiftFourViews");
  action->setToolTip(tr(
    "Show axial, 3D, coronal and sagittal views of the active volume. Their slices are linked."));
  QObject::connect(action, &QAction::triggered, this, &FourViewsActions::layOut);
  const auto enable = [action](pqPipelineSource* source) { action->setEnabled(isVolume(source)); };
  pqActiveObjects& active = pqActiveObjects::instance();
  QObject::connect(&active, &pqActiveObjects::sourceChanged, this, enable);
  QObject::connect(&active, &pqActiveObjects::dataUpdated, this,
    [enable] { enable(pqActiveObjects::instance().activeSource()); });
  enable(active.activeSource());
}

void FourViewsActions::layOut()
{
  SCOPED_UNDO_EXCLUDE();
  vtkPythonInterpreter::Initialize();
  vtkPythonInterpreter::RunSimpleString("import brainshift\n"
                                        "from paraview import simple\n"
                                        "brainshift.four_views(simple.GetActiveSource())\n");
}
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Displays/FourViewsActions.h"

#include "Interaction/Commands/Application.h"

#include <pqActiveObjects.h>
#include <pqPipelineSource.h>
#include <pqTabbedMultiViewWidget.h>

#include <vtkPVDataInformation.h>
#include <vtkPythonInterpreter.h>
#include <vtkSMSourceProxy.h>
#include <vtkSMViewLayoutProxy.h>

#include <QAction>
#include <QIcon>
#include <QTimer>
#include <QVariant>

#include <cstring>

namespace brainshift
{
namespace
{
constexpr const char* Unapplied = "BrainShiftUnapplied"; // Qt property of a filter

bool isVolume(pqPipelineSource* source)
{
  auto proxy = source ? vtkSMSourceProxy::SafeDownCast(source->getProxy()) : nullptr;
  return proxy && proxy->GetOutputPortsCreated() &&
    proxy->GetDataInformation(0)->DataSetTypeIsA("vtkImageData");
}

// In the window's own Python, with `brainshift` and `simple`.
void runPython(const QString& statements)
{
  const QString imports = "import brainshift\nfrom paraview import simple\n";
  vtkPythonInterpreter::Initialize();
  vtkPythonInterpreter::RunSimpleString((imports + statements).toUtf8().constData());
}

void showComparison(pqPipelineSource* source)
{
  SCOPED_UNDO_SET("Show comparison");
  runPython(QString("for source in list(simple.GetSources().values()):\n"
                    "    if source.SMProxy.GetGlobalID() == %1:\n"
                    "        brainshift.show_comparison(source)\n"
                    "del source\n")
      .arg(source->getProxy()->GetGlobalID()));
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
  QObject::connect(serverManagerModel(), &pqServerManagerModel::sourceAdded, this,
    &FourViewsActions::watchComparison);
}

void FourViewsActions::layOut()
{
  SCOPED_UNDO_SET("Four Views");
  auto tabs = qobject_cast<pqTabbedMultiViewWidget*>(
    pqApplicationCore::instance()->manager("MULTIVIEW_WIDGET"));
  vtkSMProxy* layout = tabs ? tabs->layoutProxy() : nullptr; // the tab at the front
  runPython(QString("from brainshift.views import begin_in_layout\n"
                    "begin_in_layout(%1)\n"
                    "brainshift.four_views(simple.GetActiveSource())\n"
                    "del begin_in_layout\n")
      .arg(layout ? layout->GetGlobalID() : 0));
}

// When it is applied for the first time, and ParaView has shown it and hidden its input. What a
// state file or a script makes was never unapplied; it is shown as they set it.
void FourViewsActions::watchComparison(pqPipelineSource* source)
{
  if (std::strcmp(source->getProxy()->GetXMLName(), "CompareVolumes") != 0)
  {
    return;
  }
  QObject::connect(source, &pqPipelineSource::modifiedStateChanged, this, [source] {
    if (source->modifiedState() == pqProxy::UNINITIALIZED)
    {
      source->setProperty(Unapplied, true);
    }
    else if (source->modifiedState() == pqProxy::UNMODIFIED && source->property(Unapplied).toBool())
    {
      source->setProperty(Unapplied, false);
      if (!isReplayed()) // else it is a step to redo, which a new step would take off the stack
      {
        QTimer::singleShot(0, source, [source] { showComparison(source); });
      }
    }
  });
}
}

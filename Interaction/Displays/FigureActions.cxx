// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Displays/FigureActions.h"

#include "Interaction/Commands/Application.h"
#include "Interaction/Views/ActiveDeformation.h"

#include <pqActiveObjects.h>
#include <pqCoreUtilities.h>
#include <pqFileDialog.h>
#include <pqPipelineSource.h>
#include <pqUndoStack.h>

#include <vtkPVSession.h>
#include <vtkPythonInterpreter.h>

#include <QAction>
#include <QMainWindow>
#include <QStatusBar>

namespace brainshift
{
namespace
{
// Any text as a Python expression.
QByteArray quoted(const QString& text)
{
  return "bytes.fromhex('" + text.toUtf8().toHex() + "').decode()";
}

// Empty if the user cancels. The folder is on the machine of the window, as the pictures are.
QString chosenFolder()
{
  pqFileDialog dialog(nullptr, pqCoreUtilities::mainWidget(),
    FigureActions::tr("Save BrainShift figures into a folder"));
  dialog.setObjectName("BrainShiftFiguresDialog");
  dialog.setFileMode(pqFileDialog::Directory, vtkPVSession::CLIENT);
  const bool chosen = dialog.exec() == QDialog::Accepted && !dialog.getSelectedFiles().isEmpty();
  return chosen ? dialog.getSelectedFiles().first() : QString();
}

void report(const QString& message)
{
  if (auto window = qobject_cast<QMainWindow*>(pqCoreUtilities::mainWidget()))
  {
    window->statusBar()->showMessage(message);
  }
}
}

FigureActions::FigureActions(QObject* parent)
  : QActionGroup(parent)
{
  QAction* action = this->addAction(tr("Save BrainShift Figures..."));
  action->setObjectName("actionBrainShiftFigures");
  action->setToolTip(tr("Save pictures of the volume before and after bending, their difference, "
                        "the histogram of the trace and all numbers into a folder."));
  this->connect(action, &QAction::triggered, this, &FigureActions::save);
  const auto enable = [action] { action->setEnabled(activeDeformation() != nullptr); };
  this->connect(&pqActiveObjects::instance(), &pqActiveObjects::sourceChanged, this, enable);
  auto model = serverManagerModel();
  this->connect(model, &pqServerManagerModel::sourceAdded, this, enable);
  this->connect(model, &pqServerManagerModel::sourceRemoved, this, enable);
  enable();
}

void FigureActions::save()
{
  pqPipelineSource* bent = activeDeformation();
  const QString folder = bent ? chosenFolder() : QString();
  if (folder.isEmpty())
  {
    return;
  }
  SCOPED_UNDO_EXCLUDE();
  vtkPythonInterpreter::Initialize();
  const QByteArray call = "import brainshift\n"
                          "from paraview import servermanager\n"
                          "brainshift.figure(servermanager.ProxyManager().GetProxy('sources', " +
    quoted(bent->getSMName()) + "), " + quoted(folder) + ")\n";
  const bool saved = vtkPythonInterpreter::RunSimpleString(call.constData()) == 0;
  report(saved ? tr("BrainShift's figures are in %1").arg(folder)
               : tr("BrainShift's figures were not saved. See the output window for the reason."));
}
}

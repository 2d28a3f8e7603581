// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Displays/DrawAllVoxels.h"

#include "Interaction/Cases/PythonCall.h"
#include "Interaction/Commands/Application.h"
#include "Interaction/Displays/FinerDetail.h"
#include "Interaction/Views/ActiveDeformation.h"

#include <pqActiveObjects.h>
#include <pqCoreUtilities.h>
#include <pqDataRepresentation.h>
#include <pqFileDialog.h>
#include <pqPipelineFilter.h>
#include <pqServer.h>
#include <pqView.h>

#include <vtkSMPropertyHelper.h>
#include <vtkSMSession.h>
#include <vtkSMSourceProxy.h>

#include <QApplication>
#include <QFileInfo>
#include <QJsonDocument>
#include <QJsonObject>
#include <QLineEdit>
#include <QMainWindow>
#include <QStatusBar>

#include <cstring>

namespace brainshift
{
namespace
{
constexpr int QuietMs = 200; // after the last picture

bool isKind(pqPipelineSource* source, const char* name)
{
  return std::strcmp(source->getProxy()->GetXMLName(), name) == 0;
}

// Null if there is none.
pqPipelineSource* firstInputOf(pqPipelineSource* source)
{
  auto filter = qobject_cast<pqPipelineFilter*>(source);
  return filter && filter->getInputCount() > 0 ? filter->getInput(0) : nullptr;
}

// The source to write for what a display shows: its deformation, or a volume that none bends. Null
// where an image of the volume would not bring bricks to this display.
pqPipelineSource* sourceOf(pqDataRepresentation* display)
{
  pqPipelineSource* source = display->getInput();
  while (source && (isKind(source, "CompareVolumes") || isKind(source, "Resection")))
  {
    source = firstInputOf(source);
  }
  const bool isMade =
    source && !isDeformation(source) && (isKind(source, "Moments") || deformationUpstream(source));
  return isMade ? nullptr : source;
}

// The source of the first volume that a view shows coarser. Null if there is none.
pqPipelineSource* coarserIn(pqView* view)
{
  for (pqRepresentation* each : view->getRepresentations())
  {
    auto display = qobject_cast<pqDataRepresentation*>(each);
    const bool isOurs =
      display && display->isVisible() && (showsVolume(display) || showsSlices(display));
    pqPipelineSource* source = isOurs ? sourceOf(display) : nullptr;
    if (source && detailNumbersOf(display)[NeedsPyramid] > 0.0)
    {
      return source;
    }
  }
  return nullptr;
}

// The path beside the file of a volume; a name alone if there is none.
QString proposedPath(pqPipelineSource* source)
{
  pqPipelineSource* volume = source;
  while (pqPipelineSource* input = firstInputOf(volume))
  {
    volume = input;
  }
  const vtkSMPropertyHelper file(volume->getProxy(), "FileName", /*quiet*/ true);
  const char* name = file.GetNumberOfElements() > 0 ? file.GetAsString() : nullptr;
  const QString path = name ? QString::fromUtf8(name) : QString();
  const QFileInfo info(path.endsWith('/') ? path.chopped(1) : path);
  const QString folder = path.isEmpty() ? QString() : info.path() + "/";
  const QString stem = path.isEmpty() ? volume->getSMName() : info.fileName();
  return folder + stem.section('.', 0, 0) + ".ome.zarr";
}

// Empty if the user cancels. The folder is on the machine that has the volume.
QString chosenFolder(pqPipelineSource* source)
{
  const QString proposed = proposedPath(source);
  const QFileInfo info(proposed);
  pqFileDialog dialog(source->getServer(), pqCoreUtilities::mainWidget(),
    DrawAllVoxels::tr("Save the volume as an OME-Zarr image"),
    proposed.contains('/') ? info.path() : QString(),
    DrawAllVoxels::tr("OME-Zarr images (*.ome.zarr *.zarr)"));
  dialog.setObjectName("BrainShiftPyramidDialog");
  dialog.setFileMode(pqFileDialog::AnyFile);
  if (auto name = dialog.findChild<QLineEdit*>("EntityName"))
  {
    name->insert(info.fileName()); // which enables OK, as typing does
  }
  const bool chosen = dialog.exec() == QDialog::Accepted && !dialog.getSelectedFiles().isEmpty();
  const QString path = chosen ? dialog.getSelectedFiles().first() : QString();
  return path.isEmpty() || path.endsWith(".zarr") ? path : path + ".ome.zarr";
}

void showInStatusBar(const QString& message)
{
  constexpr int shownMs = 5000;
  if (auto window = qobject_cast<QMainWindow*>(pqCoreUtilities::mainWidget()))
  {
    window->statusBar()->showMessage(message, shownMs);
  }
}

// Why nothing was changed; empty if it was.
QString drawFrom(const QString& folder, pqPipelineSource* source)
{
  SCOPED_UNDO_SET("Draw all voxels");
  const QJsonObject asked{ { "source", source->getSMName() }, { "out", folder } };
  const auto answer = callPython("brainshift.pyramids", "draw_in_window",
    QJsonDocument(asked).toJson(QJsonDocument::Compact).toStdString());
  const QString problem =
    answer ? QString::fromStdString(*answer) : DrawAllVoxels::tr("Output Messages have the reason");
  if (!problem.isEmpty())
  {
    forgetStep();
    return problem;
  }
  for (pqView* view : viewsShowing(source))
  {
    view->forceRender(); // what the window does to a new display then belongs to the step
  }
  return {};
}
}

DrawAllVoxels::DrawAllVoxels(QObject* parent)
  : QObject(parent)
{
  this->Soon.setSingleShot(true);
  this->Soon.setInterval(QuietMs);
  this->connect(&this->Soon, &QTimer::timeout, this, &DrawAllVoxels::ask);
  pqServerManagerModel* model = serverManagerModel();
  const auto watch = [this](pqView* view) {
    this->connect(view, &pqView::endRender, this, &DrawAllVoxels::askSoon);
  };
  this->connect(model, &pqServerManagerModel::viewAdded, this, watch);
  for (pqView* view : model->findItems<pqView*>())
  {
    watch(view);
  }
  // A question must not keep alive what is deleted.
  this->connect(model, &pqServerManagerModel::preServerRemoved, this, [this] {
    this->Soon.stop();
    this->offer(nullptr);
  });
  this->connect(model, &pqServerManagerModel::sourceRemoved, this, &DrawAllVoxels::askSoon);
  this->connect(qApp, &QCoreApplication::aboutToQuit, &this->Soon, &QTimer::stop);
  this->connect(
    &pqActiveObjects::instance(), &pqActiveObjects::viewChanged, this, &DrawAllVoxels::askSoon);
}

void DrawAllVoxels::askSoon()
{
  this->Soon.start();
}

void DrawAllVoxels::ask()
{
  pqView* view = pqActiveObjects::instance().activeView();
  const bool isDrawing = QApplication::mouseButtons() != Qt::NoButton ||
    (view && view->getProxy()->GetSession()->GetPendingProgress());
  if (isDrawing)
  {
    this->askSoon();
    return;
  }
  this->offer(view ? coarserIn(view) : nullptr);
}

void DrawAllVoxels::offer(pqPipelineSource* coarser)
{
  this->Coarser = coarser;
  Q_EMIT this->changed();
}

void DrawAllVoxels::begin()
{
  const QPointer<pqPipelineSource> source = this->Coarser;
  const QString folder = source ? chosenFolder(source) : QString();
  if (folder.isEmpty() || !source) // closed meanwhile
  {
    return;
  }
  const QString problem = drawFrom(folder, source);
  if (problem.isEmpty())
  {
    showInStatusBar(tr("The volume is drawn from %1.").arg(folder));
  }
  else
  {
    Q_EMIT this->failed(tr("The volume is drawn as before: %1.").arg(problem));
  }
}
}

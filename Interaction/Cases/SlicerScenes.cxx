// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Cases/SlicerScenes.h"

#include "Interaction/Cases/PythonCall.h"
#include "Interaction/Commands/Application.h"

#include <pqObjectBuilder.h>
#include <pqPipelineSource.h>
#include <pqUndoStack.h>

#include <vtkSMPropertyHelper.h>
#include <vtkSMProxy.h>

#include <QTimer>

#include <cstring>

namespace brainshift
{
namespace
{
void open(pqPipelineSource* source, bool isRedone)
{
  const char* name = vtkSMPropertyHelper(source->getProxy(), "FileName").GetAsString();
  const std::string file = name ? name : "";
  {
    SCOPED_UNDO_EXCLUDE(); // undone, it would open the scene again
    pqApplicationCore::instance()->getObjectBuilder()->destroy(source);
  }
  if (!isRedone)
  {
    SCOPED_UNDO_SET("Open scene");
    callPython("brainshift.openscene", "open_in_window", file);
  }
}
}

SlicerScenes::SlicerScenes(QObject* parent)
  : QObject(parent)
{
  this->connect(
    serverManagerModel(), &pqServerManagerModel::sourceAdded, this, &SlicerScenes::openSoon);
}

void SlicerScenes::openSoon(pqPipelineSource* source)
{
  if (std::strcmp(source->getProxy()->GetXMLName(), "SlicerSceneReader") == 0 &&
    !pqApplicationCore::instance()->isLoadingState())
  {
    // What Redo brings back has opened its scene before.
    const pqUndoStack* stack = pqApplicationCore::instance()->getUndoStack();
    const bool isRedone = stack && (stack->getInUndo() || stack->getInRedo());
    // Once File > Open has named the file.
    QTimer::singleShot(0, source, [source, isRedone] { open(source, isRedone); });
  }
}
}

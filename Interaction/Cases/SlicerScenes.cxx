// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Cases/SlicerScenes.h"

#include "Interaction/Cases/PythonCall.h"
#include "Interaction/Commands/Application.h"

#include <pqObjectBuilder.h>
#include <pqPipelineSource.h>

#include <vtkSMPropertyHelper.h>
#include <vtkSMProxy.h>

#include <QTimer>

#include <cstring>

namespace brainshift
{
namespace
{
void open(pqPipelineSource* source)
{
  const char* name = vtkSMPropertyHelper(source->getProxy(), "FileName").GetAsString();
  const std::string file = name ? name : "";
  pqApplicationCore::instance()->getObjectBuilder()->destroy(source);
  callPython("brainshift.openscene", "open_in_window", file);
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
    // Once File > Open has named the file.
    QTimer::singleShot(0, source, [source] { open(source); });
  }
}
}

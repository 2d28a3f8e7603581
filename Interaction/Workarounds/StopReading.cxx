// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Workarounds/StopReading.h"

#include "Formats/Volumes/WriterAtWork.h"
#include "Formats/Volumes/vtkVolumeFileReader.h"

#include <pqApplicationCore.h>
#include <pqCoreUtilities.h>
#include <pqPipelineSource.h>
#include <pqProgressManager.h>
#include <pqServerManagerModel.h>
#include <vtkPVVersion.h>
#include <vtkSMProxy.h>

#include <QAbstractButton>
#include <QApplication>
#include <QMouseEvent>

#include <vector>

namespace brainshift
{
namespace
{
// Readers that read at this moment, in this process.
std::vector<vtkVolumeFileReader*> readersAtWork()
{
  std::vector<vtkVolumeFileReader*> readers;
  const pqServerManagerModel* model = pqApplicationCore::instance()->getServerManagerModel();
  for (pqPipelineSource* source : model->findItems<pqPipelineSource*>())
  {
    auto* reader = vtkVolumeFileReader::SafeDownCast(source->getProxy()->GetClientSideObject());
    if (reader && reader->GetIsReading())
    {
      readers.push_back(reader);
    }
  }
  return readers;
}

}

StopReading::StopReading(QObject* parent)
  : QObject(parent)
  , Manager(pqApplicationCore::instance()->getProgressManager())
{
  this->connect(
    this->Manager, &pqProgressManager::progressStartEvent, this, &StopReading::findCross);
  this->connect(this->Manager, &pqProgressManager::progress, this, &StopReading::handlePress);
#if PARAVIEW_VERSION_MAJOR < 6 || (PARAVIEW_VERSION_MAJOR == 6 && PARAVIEW_VERSION_MINOR < 1)
  this->connect(this->Manager, &pqProgressManager::progressEndEvent, this,
    [this] { this->Manager->setEnableAbort(false); });
#endif
}

// Once: each picture of a drag makes progress, too. The window may not have its status bar yet.
void StopReading::findCross()
{
  const QWidget* window = this->Cross ? nullptr : pqCoreUtilities::mainWidget();
  this->Cross = window ? window->findChild<QAbstractButton*>("AbortButton") : this->Cross.data();
  if (window && this->Cross)
  {
    this->connect(this->Cross, &QAbstractButton::pressed, this, &StopReading::stop);
  }
}

bool StopReading::isOnCross(const QMouseEvent& event) const
{
  return this->Cross &&
    this->Cross->rect().contains(this->Cross->mapFromGlobal(event.globalPosition().toPoint()));
}

void StopReading::handlePress()
{
  if (this->IsHandling || !(WriterAtWork::find() || !readersAtWork().empty()))
  {
    return;
  }
  this->IsHandling = true;
  this->Manager->setEnableAbort(true);
  // ParaView would block a press before it knows which button it is for.
  const bool wasUnblocked = this->Manager->unblockEvents(true);
  QApplication::instance()->installEventFilter(this);
  QApplication::processEvents();
  QApplication::instance()->removeEventFilter(this);
  this->Manager->unblockEvents(wasUnblocked);
  this->IsHandling = false;
}

void StopReading::stop() const
{
  if (vtkAlgorithm* writer = WriterAtWork::find())
  {
    writer->SetAbortExecuteAndUpdateTime();
    return; // its source reads a piece to its end, for those who show it
  }
  for (vtkVolumeFileReader* reader : readersAtWork())
  {
    reader->SetAbortExecuteAndUpdateTime();
  }
}

// Nothing may draw or read while a reader or a writer is at work: timers fire again later.
bool StopReading::eventFilter(QObject*, QEvent* event)
{
  switch (event->type())
  {
    case QEvent::MouseButtonPress:
    case QEvent::MouseButtonRelease:
    case QEvent::MouseButtonDblClick:
      return !this->isOnCross(*static_cast<QMouseEvent*>(event));
    case QEvent::Timer:
    case QEvent::Wheel:
    case QEvent::MouseMove:
    case QEvent::HoverMove:
    case QEvent::KeyPress:
    case QEvent::KeyRelease:
    case QEvent::Shortcut:
    case QEvent::ShortcutOverride:
    case QEvent::ContextMenu:
    case QEvent::Close:
    case QEvent::DragEnter:
    case QEvent::DragMove:
    case QEvent::Drop:
      return true;
    default:
      return false;
  }
}
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Displays/FinerDetail.h"

#include "Interaction/Commands/Application.h"
#include "Interaction/Views/Reports.h"

#include <pqCoreUtilities.h>
#include <pqDataRepresentation.h>
#include <pqView.h>

#include <vtkPVArrayInformation.h>
#include <vtkPVDataInformation.h>
#include <vtkPVDataSetAttributesInformation.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMRepresentationProxy.h>
#include <vtkSMSession.h>

#include <QApplication>
#include <QMainWindow>
#include <QStatusBar>

#include <cstring>

namespace brainshift
{
namespace
{
constexpr int EachMs = 100;    // ten pictures a second at most
constexpr int WatchedMs = 500; // where nothing is to come

// Whether its volume is read from a file with levels. Others are asked nothing.
bool hasLevels(pqDataRepresentation* display)
{
  vtkPVDataInformation* data = display->isVisible() ? display->getInputDataInformation() : nullptr;
  vtkSMPropertyHelper kind(display->getProxy(), "Representation", /*quiet*/ true);
  return data && kind.GetNumberOfElements() == 1 &&
    std::strcmp(kind.GetAsString(), "Deformed Volume") == 0 &&
    data->GetFieldDataInformation()->GetArrayInformation("OMEZarrLevel");
}

void say(const std::vector<double>& detail)
{
  auto window = qobject_cast<QMainWindow*>(pqCoreUtilities::mainWidget());
  if (!window || detail[0] < 0)
  {
    return;
  }
  const QString drawn =
    QString("Level %1 of the volume: %2 bricks are drawn").arg(detail[0]).arg(detail[1]);
  constexpr int shownMs = 3000;
  window->statusBar()->showMessage(detail[2] > 0
      ? drawn + QString(", %1 are still to come").arg(detail[2])
      : detail[3] > 0 ? drawn + "; there is no memory for more, so the rest is coarser"
                      : drawn,
    shownMs);
}

// Draws once more if something is to come. Returns whether it was.
bool draw(pqDataRepresentation* display)
{
  pqView* view = display->getView();
  if (!view || view->getProxy()->GetSession()->GetPendingProgress())
  {
    return false;
  }
  const vtkSmartPointer<vtkSMProxy> report =
    makeReport(display->getProxy(), "DeformedVolumeReport");
  pointAt(report, "Representation", display->getProxy());
  const std::vector<double> detail = answerOf(report, "Detail");
  if (detail.size() != 4 || detail[2] <= 0)
  {
    return false;
  }
  view->forceRender();
  say(answerOf(report, "Detail"));
  return true;
}
}

FinerDetail::FinerDetail(QObject* parent)
  : QObject(parent)
{
  this->Next.setSingleShot(true);
  this->Next.setInterval(WatchedMs);
  QObject::connect(&this->Next, &QTimer::timeout, this, &FinerDetail::drawOn);
  this->Next.start();
}

void FinerDetail::drawOn()
{
  bool isLoading = false;
  if (QApplication::mouseButtons() == Qt::NoButton) // else the hand draws
  {
    for (pqDataRepresentation* display : serverManagerModel()->findItems<pqDataRepresentation*>())
    {
      isLoading = (hasLevels(display) && draw(display)) || isLoading;
    }
  }
  this->Next.start(isLoading ? EachMs : WatchedMs);
}
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Interaction/Displays/FinerDetail.h"

#include "Interaction/Commands/Application.h"
#include "Interaction/Views/Reports.h"

#include <pqCoreUtilities.h>
#include <pqDataRepresentation.h>
#include <pqServerManagerModel.h>
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
constexpr int EachMs = 100;    // how often it asks while bricks are read
constexpr int AtMostMs = 1000; // without a picture while bricks are read

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
    QString("Level %1: %2 bricks are drawn").arg(detail[0]).arg(detail[1]);
  constexpr int shownMs = 3000;
  window->statusBar()->showMessage(detail[2] > 0
      ? drawn + QString(", %1 are to come").arg(detail[2])
      : detail[3] > 0 ? drawn + "; memory is full, the rest is coarser"
                      : drawn,
    shownMs);
}

enum class Detail
{
  Complete,
  Coming, // a picture a little later shows more
  Drawn
};

// Draws once more if something is to come.
Detail draw(pqDataRepresentation* display, bool isLate)
{
  pqView* view = display->getView();
  if (!view || view->getProxy()->GetSession()->GetPendingProgress())
  {
    return view ? Detail::Coming : Detail::Complete;
  }
  const vtkSmartPointer<vtkSMProxy> report =
    makeReport(display->getProxy(), "DeformedVolumeReport");
  pointAt(report, "Representation", display->getProxy());
  const std::vector<double> detail = answerOf(report, "Detail");
  if (detail.size() != 5 || detail[2] <= 0)
  {
    return Detail::Complete;
  }
  if (detail[4] > 0 && !isLate)
  {
    return Detail::Coming;
  }
  view->forceRender();
  say(answerOf(report, "Detail"));
  return Detail::Drawn;
}
}

FinerDetail::FinerDetail(QObject* parent)
  : QObject(parent)
{
  this->Next.setSingleShot(true);
  this->Next.setInterval(EachMs);
  QObject::connect(&this->Next, &QTimer::timeout, this, &FinerDetail::drawOn);
  const auto watch = [this](pqView* view) {
    QObject::connect(view, &pqView::endRender, this, &FinerDetail::watch);
  };
  QObject::connect(serverManagerModel(), &pqServerManagerModel::viewAdded, this, watch);
  for (pqView* view : serverManagerModel()->findItems<pqView*>())
  {
    watch(view);
  }
}

// After each picture rays may ask for more.
void FinerDetail::watch()
{
  if (!this->Next.isActive())
  {
    this->Next.start();
  }
}

void FinerDetail::drawOn()
{
  if (QApplication::mouseButtons() != Qt::NoButton) // the hand draws
  {
    this->Next.start();
    return;
  }
  bool isLoading = false;
  const bool isLate = this->SinceDrawn.isValid() && this->SinceDrawn.elapsed() > AtMostMs;
  for (pqDataRepresentation* display : serverManagerModel()->findItems<pqDataRepresentation*>())
  {
    const Detail detail = hasLevels(display) ? draw(display, isLate) : Detail::Complete;
    isLoading = isLoading || detail != Detail::Complete;
    if (detail == Detail::Drawn)
    {
      this->SinceDrawn.start();
    }
  }
  if (isLoading)
  {
    if (!this->SinceDrawn.isValid())
    {
      this->SinceDrawn.start();
    }
    this->Next.start();
  }
  else
  {
    this->SinceDrawn.invalidate();
    this->Next.stop();
  }
}
}

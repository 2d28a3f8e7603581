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

#include <string>
#include <utility>

namespace brainshift
{
std::vector<double> detailNumbersOf(pqDataRepresentation* display)
{
  const vtkSmartPointer<vtkSMProxy> report =
    makeReport(display->getProxy(), "DeformedVolumeReport");
  pointAt(report, "Representation", display->getProxy());
  std::vector<double> numbers = answerOf(report, "Detail");
  numbers.resize(DetailNumbers);
  return numbers;
}

namespace
{
constexpr int EachMs = 100;    // how often it asks while bricks are read
constexpr int AtMostMs = 1000; // without a picture while there are bricks to show

// Whether its volume is read from a file with levels. Others are asked nothing.
bool hasLevels(pqDataRepresentation* display)
{
  vtkPVDataInformation* data = display->isVisible() ? display->getInputDataInformation() : nullptr;
  vtkSMPropertyHelper kind(display->getProxy(), "Representation", /*quiet*/ true);
  const std::string drawnAs = kind.GetNumberOfElements() == 1 ? kind.GetAsString() : "";
  return data && (drawnAs == "Deformed Volume" || drawnAs == "Deformed Slices") &&
    data->GetFieldDataInformation()->GetArrayInformation("OMEZarrLevel");
}

// In the status bar. `detail`: as the report gives it.
void showInStatusBar(const std::vector<double>& detail)
{
  auto window = qobject_cast<QMainWindow*>(pqCoreUtilities::mainWidget());
  if (!window || detail[Level] < 0)
  {
    return;
  }
  const QString drawn =
    QString("Level %1: %2 bricks are drawn").arg(detail[Level]).arg(detail[Drawn]);
  constexpr int shownMs = 3000;
  window->statusBar()->showMessage(detail[ToCome] > 0
      ? drawn + QString(", %1 are to come").arg(detail[ToCome])
      : detail[IsOverfull] > 0 ? drawn + "; memory is full, the rest is coarser"
                               : drawn,
    shownMs);
}

enum class Detail // in the order of haste
{
  Complete,
  Reading, // a picture now would show nothing more
  Read,    // it would show some, and a little later more
  Ready
};

Detail detailOf(pqDataRepresentation* display)
{
  if (display->getView()->getProxy()->GetSession()->GetPendingProgress())
  {
    return Detail::Reading;
  }
  const std::vector<double> numbers = detailNumbersOf(display);
  if (numbers[ToCome] <= 0)
  {
    return Detail::Complete;
  }
  return numbers[IsReading] <= 0 ? Detail::Ready
    : numbers[HasUnshown] > 0    ? Detail::Read
                                 : Detail::Reading;
}

struct HastiestDisplay // of a view
{
  Detail detail = Detail::Complete;
  pqDataRepresentation* display = nullptr;
};

std::map<pqView*, HastiestDisplay> hastiestDisplays()
{
  std::map<pqView*, HastiestDisplay> found;
  for (pqDataRepresentation* display : serverManagerModel()->findItems<pqDataRepresentation*>())
  {
    const bool isAsked = display->getView() && hasLevels(display);
    const Detail detail = isAsked ? detailOf(display) : Detail::Complete;
    if (detail != Detail::Complete && found[display->getView()].detail < detail)
    {
      found[display->getView()] = { detail, display };
    }
  }
  return found;
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

// After each picture more may be asked for.
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
  std::map<pqView*, QElapsedTimer> coming;
  for (const auto& [view, hastiest] : hastiestDisplays())
  {
    const auto known = this->SinceDrawn.find(view);
    QElapsedTimer since;
    since.start();
    since = known == this->SinceDrawn.end() ? since : known->second;
    const bool isLate = since.elapsed() > AtMostMs;
    if (hastiest.detail == Detail::Ready || (hastiest.detail == Detail::Read && isLate))
    {
      view->forceRender();
      showInStatusBar(detailNumbersOf(hastiest.display));
      since.start();
    }
    coming[view] = since;
  }
  this->SinceDrawn = std::move(coming);
  if (this->SinceDrawn.empty())
  {
    this->Next.stop();
  }
  else
  {
    this->Next.start();
  }
}
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Window/StatusLine.h"

#include "Filters/Fit/Fit.h"
#include "Interaction/Commands/Application.h"
#include "Interaction/Displays/DrawAllVoxels.h"
#include "Interaction/Workarounds/QuietMessages.h"
#include "Panel/Tools/ToolPanel.h"

#include <pqRenderView.h>

#include <vtkCommand.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkSMRenderViewProxy.h>
#include <vtkSMSession.h>

#include <QApplication>
#include <QHBoxLayout>
#include <QStringList>
#include <QToolButton>

namespace brainshift
{
namespace
{
constexpr int AskEachMs = 50; // at most; faster than one can read

// The sides of the patient towards greater and towards smaller x, y and z.
struct Sides
{
  const char* greater;
  const char* smaller;
};

Sides sidesOf(WorldAxes axes)
{
  return axes == WorldAxes::RAS ? Sides{ "RAS", "LPI" } : Sides{ "LPS", "RAI" };
}

QString placeText(const glm::dvec3& mm, WorldAxes axes)
{
  QStringList parts;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (axes == WorldAxes::Unknown)
    {
      parts.append(QString("%1 %2").arg(QChar("xyz"[axis])).arg(mm[axis], 0, 'f', 1));
      continue;
    }
    const Sides sides = sidesOf(axes);
    const char side = mm[axis] < 0.0 ? sides.smaller[axis] : sides.greater[axis];
    parts.append(QString("%1 %2").arg(QChar(side)).arg(std::abs(mm[axis]), 0, 'f', 1));
  }
  return parts.join(' ');
}

QSize sizeOf(pqRenderView* view)
{
  const int* size = view->getRenderViewProxy()->GetRenderWindow()->GetSize();
  return { size[0], size[1] };
}

QString numberText(double number)
{
  return QString::number(number, 'g', 6);
}
}

namespace
{
// The uncertainty of a position. The limit is that of the pictures.
QString uncertaintyText(double deviation)
{
  constexpr double unknownMm = 4.0; // from here on pictures show the position as unknown
  return deviation < unknownMm ? CursorLine::tr("uncertainty: \u00b1 %1 mm (95 %: %2 mm)")
                                   .arg(deviation, 0, 'f', 1)
                                   .arg(DeviationsOfBall95 * deviation, 0, 'f', 1)
                               : CursorLine::tr("uncertainty: %1 mm or more").arg(unknownMm);
}
}

QString cursorText(const CursorTissue& tissue)
{
  QStringList parts;
  parts.append(CursorLine::tr("%1 mm").arg(placeText(tissue.deformed, tissue.axes)));
  if (tissue.bent)
  {
    parts.append(CursorLine::tr("before %1 mm").arg(placeText(tissue.rest, tissue.axes)));
  }
  if (tissue.intensity)
  {
    parts.append(CursorLine::tr("intensity %1").arg(numberText(*tissue.intensity)));
  }
  if (tissue.reference)
  {
    parts.append(CursorLine::tr("reference %1").arg(numberText(*tissue.reference)));
  }
  if (!tissue.label.isEmpty())
  {
    parts.append(CursorLine::tr("label %1").arg(tissue.label));
  }
  if (tissue.bent)
  {
    const double moved = glm::distance(tissue.deformed, tissue.rest);
    parts.append(CursorLine::tr("moved %1 mm").arg(moved, 0, 'f', 1));
    parts.append(tissue.jacobian > 0.0
        ? CursorLine::tr("volume %1 %").arg(100.0 * tissue.jacobian, 0, 'f', 0)
        : CursorLine::tr("folded"));
  }
  if (tissue.deviation)
  {
    parts.append(uncertaintyText(*tissue.deviation));
  }
  return parts.join(QStringLiteral(" \u00b7 "));
}

CursorLine::CursorLine(QWidget* parent)
  : QLabel(parent)
  , Cursor(this)
{
  this->setObjectName("BrainShiftCursor");
  this->setContentsMargins(6, 0, 6, 0);
  this->setTextFormat(Qt::PlainText); // names come from files
  this->setToolTip(
    tr("The tissue under the cursor: position (mm), position before the deformation (mm), value "
       "and label of the nearest voxel, displacement (mm), current volume (100 %: unchanged), and "
       "uncertainty of the position (mm). The uncertainty is one standard deviation along an axis, "
       "and the radius of the ball that contains the tissue with 95 % probability."));
  this->Asking.setSingleShot(true);
  this->Asking.setInterval(AskEachMs);
  this->connect(&this->Asking, &QTimer::timeout, this, &CursorLine::ask);
  this->connect(&this->Cursor, &CursorWatch::moved, this, &CursorLine::follow);
  this->connect(&this->Cursor, &CursorWatch::left, this, &CursorLine::fallSilent);
  pqServerManagerModel* model = serverManagerModel();
  // A pending question must not keep a deleted proxy alive.
  this->connect(model, &pqServerManagerModel::preViewRemoved, this, &CursorLine::fallSilent);
  this->connect(
    model, &pqServerManagerModel::preRepresentationRemoved, this, &CursorLine::fallSilent);
  this->connect(model, &pqServerManagerModel::preServerRemoved, this, &CursorLine::fallSilent);
  this->connect(qApp, &QCoreApplication::aboutToQuit, this, &CursorLine::fallSilent);
  this->connect(model, &pqServerManagerModel::dataUpdated, this, [this] {
    this->clear(); // until the picture shows it
    this->askSoon();
  });
}

void CursorLine::follow(pqRenderView* view)
{
  if (view != this->Followed)
  {
    this->fallSilent();
    this->Followed = view;
    this->Drawing->Connect(
      view->getRenderViewProxy()->GetRenderWindow(), vtkCommand::EndEvent, this, SLOT(askSoon()));
  }
  this->Size = sizeOf(view);
  if (QApplication::mouseButtons() != Qt::NoButton) // the picture moves away under the cursor
  {
    this->clear();
  }
  this->askSoon();
}

void CursorLine::askSoon()
{
  if (!this->Asking.isActive())
  {
    this->Asking.start();
  }
}

void CursorLine::ask()
{
  vtkSMRenderViewProxy* view = this->Followed ? this->Followed->getRenderViewProxy() : nullptr;
  if (!view || !view->GetInteractor() || QApplication::mouseButtons() != Qt::NoButton ||
    view->GetSession()->GetPendingProgress() || sizeOf(this->Followed) != this->Size)
  {
    this->clear();
    return;
  }
  const int* pixel = view->GetInteractor()->GetEventPosition();
  const auto tissue = this->Probe.tissueAt(this->Followed, pixel[0], pixel[1]);
  this->setText(tissue ? cursorText(*tissue) : QString());
}

void CursorLine::fallSilent()
{
  this->Asking.stop();
  this->Drawing->Disconnect();
  this->Followed = nullptr;
  this->Probe.forget();
  this->clear();
}

StatusLine::StatusLine(QWidget* parent, QuietMessages* messages)
  : QWidget(parent)
  , Switch(new QToolButton(this))
  , Line(new QLabel(this))
  , Sign(new QToolButton(this))
  , Warning(new QLabel(this))
  , Coarser(new QLabel(tr("The volume is drawn coarser."), this))
  , DrawAll(new QToolButton(this))
  , Offer(new DrawAllVoxels(this))
{
  const ToolSettings* settings = ToolSettings::instance();
  this->Switch->setObjectName("BrainShiftSwitchVolume");
  this->Switch->setToolTip(
    tr("Select this volume, so that the tool in hand works on it. A click in the view does the "
       "same."));
  this->connect(this->Switch, &QToolButton::clicked, settings, &ToolSettings::switchWanted);
  this->Line->setObjectName("BrainShiftStatus");
  // A long line must not widen the window.
  this->Line->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  auto row = new QHBoxLayout(this);
  row->setContentsMargins(6, 0, 6, 0);
  row->addWidget(this->Switch);
  row->addWidget(this->Line, 1);
  this->Sign->setObjectName("BrainShiftMessages");
  this->Sign->setAutoRaise(true);
  this->Sign->setIcon(QIcon(":/BrainShift/warning.svg"));
  this->Sign->setToolTip(tr("Show all messages."));
  this->Sign->setAccessibleName(tr("Messages"));
  this->Warning->setObjectName("BrainShiftStatusWarning");
  this->Warning->setTextFormat(Qt::PlainText); // names come from files
  this->Warning->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  row->addWidget(this->Sign);
  row->addWidget(this->Warning, 2); // it is longer than a hint
  this->DrawAll->setObjectName("BrainShiftDrawAll");
  this->DrawAll->setText(tr("Draw All Voxels..."));
  this->DrawAll->setToolTip(
    tr("The volume is too large and is drawn coarser: save it as an OME-Zarr image, of which all "
       "voxels are drawn where the view needs them."));
  row->addWidget(this->Coarser);
  row->addWidget(this->DrawAll);
  this->connect(this->DrawAll, &QToolButton::clicked, this->Offer, &DrawAllVoxels::begin);
  this->connect(this->Offer, &DrawAllVoxels::changed, this, &StatusLine::refresh);
  this->connect(this->Offer, &DrawAllVoxels::failed, this, &StatusLine::warn);
  this->Warned.setSingleShot(true);
  this->connect(&this->Warned, &QTimer::timeout, this, [this] { this->warn(QString()); });
  this->connect(messages, &QuietMessages::said, this, &StatusLine::warn);
  this->connect(this->Sign, &QToolButton::clicked, this, [this, messages] {
    this->warn(QString());
    messages->open();
  });
  this->connect(settings, &ToolSettings::changed, this, &StatusLine::refresh);
  this->warn(QString());
  this->refresh();
}

// Nothing: no warning any more.
void StatusLine::warn(const QString& words)
{
  constexpr int warningMs = 60000; // a long one takes a while to be read
  this->Warning->setText(words);
  this->Warning->setToolTip("<p>" + words.toHtmlEscaped() + "</p>"); // wraps
  this->Sign->setVisible(!words.isEmpty());
  this->Warning->setVisible(!words.isEmpty());
  words.isEmpty() ? this->Warned.stop() : this->Warned.start(warningMs);
}

void StatusLine::refresh()
{
  const ToolSettings& settings = *ToolSettings::instance();
  const bool inHand = settings.tool() != Tool::None;
  // Without a tool the mouse has its usual gestures, except over slices.
  const bool isOurs = inHand || !settings.request().isEmpty() ||
    settings.ground() == ToolSettings::Ground::FlatSlices;
  this->Line->setText(isOurs ? mouseHint(settings, settings.ground()) : QString());
  this->Line->setToolTip(this->Line->text());
  this->Switch->setText(tr("Work on %1").arg(settings.shownInstead()));
  this->Switch->setVisible(inHand && !settings.shownInstead().isEmpty());
  this->Coarser->setVisible(this->Offer->isOffered());
  this->DrawAll->setVisible(this->Offer->isOffered());
}
}

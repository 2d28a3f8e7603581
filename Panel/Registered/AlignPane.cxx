// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Registered/AlignPane.h"

#include "Interaction/Edits/AlignEditor.h"
#include "Panel/Registered/PaneParts.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QToolButton>
#include <QVBoxLayout>

namespace brainshift
{
namespace
{
QString moved(const AlignFigures& figures)
{
  return AlignPane::tr(
    "The reference moved by %1 mm and %2 degrees. %3 % of the volume has a partner in the "
    "reference.")
    .arg(figure(figures.shift, 2), figure(figures.rotation, 2), figure(100.0 * figures.overlap, 0));
}

QString alignProgress(const AlignFigures& figures)
{
  return AlignPane::tr("Step %1: mutual information %2 nats. ")
           .arg(QString::number(figures.lines), figure(figures.information, 3)) +
    moved(figures) + (figures.isChecking ? " " + checkingText() : QString());
}

QString alignResult(const QString& ended, const AlignFigures& figures)
{
  return AlignPane::tr(
           "%1 after %2 steps. Mutual information: %3 nats before, %4 now (higher is better). ")
           .arg(ended, QString::number(figures.lines), figure(figures.informationBefore, 3),
             figure(figures.information, 3)) +
    moved(figures) + " " + trustText(figures.trust);
}
}

AlignPane::AlignPane(pqPipelineSource* compare, QWidget* parent)
  : QWidget(parent)
  , Editor(AlignEditor::of(compare))
  , Align(makeButton("BrainShiftAlign", tr("Align"),
      tr("Register the reference rigidly, from its current position. Align maximises its mutual "
         "information with the volume. Both are compared as they are drawn; the cavity is "
         "ignored.")))
  , Stop(makeButton("BrainShiftAlignStop", tr("Stop"),
      tr("Stop Align and keep the current position of the reference, as one undo step. Escape "
         "restores the position before Align.")))
  , Progress(new QProgressBar)
  , Report(makeText("BrainShiftAlignSaid"))
  , Warning(makeText("BrainShiftAlignWarning"))
  , Keep(makeKeep("BrainShiftAlignKeep"))
{
  this->setObjectName("BrainShiftAlignPane");
  this->Progress->setObjectName("BrainShiftAlignProgress");
  this->Progress->setAccessibleName(tr("Progress of the alignment"));
  this->Progress->setRange(0, WholeProgress);
  auto column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  auto row = new QHBoxLayout;
  row->addWidget(this->Align);
  row->addWidget(this->Stop);
  row->addStretch();
  column->addLayout(row);
  for (QWidget* part : { static_cast<QWidget*>(this->Progress), static_cast<QWidget*>(this->Report),
         static_cast<QWidget*>(this->Warning) })
  {
    column->addWidget(part);
  }
  column->addWidget(this->Keep);
  if (this->Editor)
  {
    this->connect(this->Align, &QToolButton::clicked, this->Editor, &AlignEditor::begin);
    this->connect(this->Keep, &QToolButton::clicked, this->Editor, &AlignEditor::keepDiscarded);
    this->connect(this->Stop, &QToolButton::clicked, this->Editor, &AlignEditor::stop);
    this->connect(this->Editor, &AlignEditor::changed, this, &AlignPane::refresh);
  }
  this->refresh();
}

void AlignPane::refresh()
{
  if (!this->Editor)
  {
    return;
  }
  const bool active = this->Editor->isActive();
  this->Align->setEnabled(!active);
  this->Stop->setEnabled(active);
  this->Keep->setVisible(this->Editor->hasDiscarded());
  this->Progress->setVisible(active);
  this->Progress->setValue(static_cast<int>(WholeProgress * this->Editor->figures().done));
  this->report();
}

void AlignPane::report()
{
  const AlignFigures& figures = this->Editor->figures();
  QString report;
  QString warning = this->Editor->problem();
  const QString ended =
    this->Editor->state() == AlignEditor::State::Kept ? tr("Stopped") : tr("Finished");
  switch (this->Editor->state())
  {
    case AlignEditor::State::Running:
    case AlignEditor::State::Paused:
      report = figures.lines > 0 ? alignProgress(figures) : tr("Preparing the search ...");
      break;
    case AlignEditor::State::Kept:
    case AlignEditor::State::Finished:
      if (figures.lines == 0)
      {
        report = tr("Stopped before the first step; nothing has changed.");
        break;
      }
      if (this->Editor->hasChangedSince())
      {
        report = changedText(ended, figures.lines);
        break;
      }
      report = alignResult(ended, figures);
      warning = figures.warning;
      break;
    case AlignEditor::State::Idle:
      break;
  }
  showTexts(this->Report, report, this->Warning, warning);
}
}

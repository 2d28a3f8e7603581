// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Registered/RefinePane.h"

#include "Interaction/Commands/Application.h"
#include "Interaction/Landmarks/LandmarkErrors.h"
#include "Panel/Registered/PaneParts.h"

#include <pqOutputPort.h>
#include <pqPipelineSource.h>

#include <vtkPVDataInformation.h>
#include <vtkSMPropertyHelper.h>
#include <vtkType.h>

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QResizeEvent>
#include <QScrollArea>
#include <QStringList>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>
#include <cstring>
#include <utility>

namespace brainshift
{
namespace
{
constexpr int LeastLetters = 10; // of a list: the panel is narrow

bool isKind(pqPipelineSource* source, const char* kind)
{
  return std::strcmp(source->getProxy()->GetXMLName(), kind) == 0;
}

bool isImage(pqPipelineSource* source)
{
  return source->modifiedState() != pqProxy::UNINITIALIZED &&
    source->getNumberOfOutputPorts() > 0 &&
    source->getOutputPort(0)->getDataInformation()->GetDataSetType() == VTK_IMAGE_DATA;
}

// Volumes that a deformation may be compared with: neither itself nor its consumers.
QList<pqPipelineSource*> volumesBeside(pqPipelineSource* deformation)
{
  QList<pqPipelineSource*> made{ deformation };
  for (int next = 0; next < made.size(); ++next)
  {
    for (pqPipelineSource* consumer : made[next]->getAllConsumers())
    {
      if (!made.contains(consumer))
      {
        made.append(consumer);
      }
    }
  }
  QList<pqPipelineSource*> volumes;
  pqServerManagerModel* model = serverManagerModel();
  for (pqPipelineSource* source : model->findItems<pqPipelineSource*>(deformation->getServer()))
  {
    if (!made.contains(source) && !source->getAllConsumers().contains(deformation) &&
      !isComparison(source) && !isKind(source, "FitDeformation") &&
      !isKind(source, "RefinedLattice") && !isKind(source, "DeformationLattice") && isImage(source))
    {
      volumes.append(source);
    }
  }
  return volumes;
}

// Fills a list, and keeps the choice if it still exists.
void fill(QComboBox* list, const QString& none, const QList<pqPipelineSource*>& sources)
{
  const QVariant before = list->currentData();
  const bool isFirst = list->count() == 0 || !before.toUInt();
  list->clear();
  if (!none.isEmpty())
  {
    list->addItem(none, 0u);
  }
  for (pqPipelineSource* source : sources)
  {
    list->addItem(source->getSMName(), source->getProxy()->GetGlobalID());
  }
  list->setCurrentIndex(isFirst ? 0 : std::max(0, list->findData(before)));
}

// In a widget of its own, whose name finds the list as it finds that of a property.
QWidget* wrapped(QWidget* part, const char* name, const QString& tip)
{
  auto wrap = new QWidget;
  wrap->setObjectName(name);
  wrap->setToolTip(tip);
  auto row = new QHBoxLayout(wrap);
  row->setContentsMargins(0, 0, 0, 0);
  row->addWidget(part);
  return wrap;
}

QComboBox* makeList(const QString& name)
{
  auto list = new QComboBox;
  list->setAccessibleName(name);
  list->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  list->setMinimumContentsLength(LeastLetters);
  list->setFocusPolicy(Qt::StrongFocus);
  return list;
}

QString wholePercent(double fraction)
{
  return figure(100.0 * fraction, 0);
}
}

QString refineProgress(const RefineFigures& figures)
{
  return RefinePane::tr(
           "Step %1: control points moved %2 mm at most, %3 mm on average. %4 % of %5 is "
           "compared.")
           .arg(QString::number(figures.steps), figure(figures.largestChange),
             figure(figures.meanChange), wholePercent(figures.overlap), figures.overlapOf) +
    (figures.isChecking ? " " + checkingText() : QString());
}

namespace
{
// What came of it. `ended`: how, as the beginning of a sentence.
QString refineResult(const QString& ended, const RefineFigures& figures)
{
  QStringList lines;
  lines += RefinePane::tr("%1 after %2 steps. Cost: %3 before, %4 now (0: the volumes match).")
             .arg(ended, QString::number(figures.steps), figure(figures.costBefore, 3),
               figure(figures.cost, 3));
  lines += RefinePane::tr("Control points moved %1 mm at most, %2 mm on average.")
             .arg(figure(figures.largestChange), figure(figures.meanChange));
  if (figures.smallestDeterminant)
  {
    lines += RefinePane::tr("Smallest Jacobian determinant: %1 (0 or less: folded).")
               .arg(figure(*figures.smallestDeterminant));
  }
  lines += figures.stepFraction < 1.0
    ? RefinePane::tr("The guard against folding shortened steps, the shortest to %1 %.")
        .arg(wholePercent(figures.stepFraction))
    : RefinePane::tr("The guard against folding shortened no step.");
  lines += RefinePane::tr("%1 % of %2 was compared.")
             .arg(wholePercent(figures.overlap), figures.overlapOf);
  lines += trustText(figures.trust);
  return lines.join(' ');
}

// What the user must check of the result; empty if nothing.
QString refineWarning(const RefineFigures& figures)
{
  QStringList lines;
  if (!figures.warning.isEmpty())
  {
    lines += figures.warning;
  }
  if (figures.smallestDeterminant && *figures.smallestDeterminant <= 0.0)
  {
    lines += RefinePane::tr(
      "Tissue is folded: the smallest Jacobian determinant is %1, and it must be above "
      "0.")
               .arg(figure(*figures.smallestDeterminant));
  }
  return lines.join(' ');
}
}

RefinePane::RefinePane(pqPipelineSource* deformation, QWidget* parent)
  : QWidget(parent)
  , Deformation(deformation)
  , Editor(RefineEditor::of(deformation))
  , OfLandmarks(LandmarkErrors::of(deformation))
  , Opener(makeButton("BrainShiftRefineOpen", tr("Refine"),
      tr("Refine the deformation automatically so that the volume matches a reference.")))
  , Body(new QWidget(this))
{
  this->setObjectName("BrainShiftRefinePane");
  this->Opener->setCheckable(true);
  this->Opener->setAutoRaise(true);
  this->Opener->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  QFont bold = this->Opener->font();
  bold.setBold(true);
  this->Opener->setFont(bold);
  auto column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(this->Opener);
  column->addWidget(this->Body);
  auto body = new QVBoxLayout(this->Body);
  body->setContentsMargins(0, 0, 0, 0);
  this->addChoices(body);
  this->addButtons(body);
  this->addProgress(body);
  this->followApplication();
  this->open(this->Editor->isActive());
  this->refresh();
}

void RefinePane::addChoices(QVBoxLayout* column)
{
  this->Choices = new QWidget;
  auto form = new QFormLayout(this->Choices);
  form->setContentsMargins(0, 0, 0, 0);
  this->Reference = makeList(tr("Reference"));
  form->addRow(tr("Reference"),
    wrapped(this->Reference, "BrainShiftRefineReference",
      tr("The volume to match. A Compare Volumes of this deformation provides its reference, in "
         "its current position, and its cavity.")));
  this->Cavity = makeList(tr("Cavity"));
  this->CavityRow = wrapped(this->Cavity, "BrainShiftRefineCavity",
    tr("A mask of tissue that the reference lacks. Tissue inside it is ignored."));
  form->addRow(tr("Cavity"), this->CavityRow);
  this->Similarity = makeList(tr("Similarity"));
  QStringList tips;
  for (const SimilarityChoice& choice : similaritiesFor(this->Deformation))
  {
    this->Similarity->addItem(choice.label);
    this->Similarity->setItemData(this->Similarity->count() - 1, choice.tooltip, Qt::ToolTipRole);
    tips += tr("%1: %2").arg(choice.label, choice.tooltip);
  }
  form->addRow(
    tr("Similarity"), wrapped(this->Similarity, "BrainShiftRefineSimilarity", tips.join('\n')));
  this->Stiffness = new QDoubleSpinBox;
  this->Stiffness->setObjectName("BrainShiftRefineStiffness");
  this->Stiffness->setAccessibleName(tr("Stiffness"));
  this->Stiffness->setRange(0.01, 100.0);
  this->Stiffness->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
  this->Stiffness->setValue(1.0);
  this->Stiffness->setFocusPolicy(Qt::StrongFocus);
  this->Stiffness->setToolTip(
    tr("Factor on the stiffness of the volume. Above 1 it bends less, below 1 it bends more."));
  form->addRow(tr("Stiffness"), this->Stiffness);
  column->addWidget(this->Choices);
  this->connect(this->Reference, &QComboBox::currentIndexChanged, this, &RefinePane::refresh);
}

void RefinePane::addButtons(QVBoxLayout* column)
{
  this->Refine = makeButton("BrainShiftRefine", tr("Refine"),
    tr("Refine the deformation step by step, from its current state. The result replaces strokes "
       "and lattice; Ctrl+Z restores them."));
  this->Pause = makeButton("BrainShiftRefinePause", tr("Resume"), tr("Pause the refinement."));
  this->Pause->setMinimumWidth(this->Pause->sizeHint().width()); // of the longer text
  this->Pause->setText(tr("Pause"));
  this->Stop = makeButton("BrainShiftRefineStop", tr("Stop"),
    tr("Stop the refinement and keep the result so far, as one undo step. Escape restores the "
       "state before the refinement instead."));
  auto row = new QHBoxLayout;
  for (QToolButton* button : { this->Refine, this->Pause, this->Stop })
  {
    row->addWidget(button);
  }
  row->addStretch();
  column->addLayout(row);
  this->connect(this->Refine, &QToolButton::clicked, this, &RefinePane::refine);
  this->connect(this->Pause, &QToolButton::clicked, this->Editor,
    [this] { this->Editor->pause(this->Editor->state() == RefineEditor::State::Running); });
  this->connect(this->Stop, &QToolButton::clicked, this->Editor, &RefineEditor::stop);
}

void RefinePane::addProgress(QVBoxLayout* column)
{
  this->Progress = new QProgressBar;
  this->Progress->setObjectName("BrainShiftRefineProgress");
  this->Progress->setAccessibleName(tr("Progress of the refinement"));
  this->Progress->setRange(0, WholeProgress);
  this->Plot = new CostPlot;
  this->Plot->setObjectName("BrainShiftRefineCurve");
  this->Report = makeText("BrainShiftRefineSaid");
  this->Warning = makeText("BrainShiftRefineWarning");
  this->Errors = makeText("BrainShiftRefineLandmarks");
  this->Errors->setToolTip(
    tr("Distance of each landmark's tissue from its measured position, before and after the "
       "refinement."));
  for (QWidget* part : { static_cast<QWidget*>(this->Progress), static_cast<QWidget*>(this->Plot),
         static_cast<QWidget*>(this->Report), static_cast<QWidget*>(this->Warning),
         static_cast<QWidget*>(this->Errors) })
  {
    column->addWidget(part);
  }
  this->Keep = makeKeep("BrainShiftRefineKeep");
  column->addWidget(this->Keep);
  this->connect(this->Keep, &QToolButton::clicked, this->Editor, &RefineEditor::keepDiscarded);
}

void RefinePane::followApplication()
{
  this->Soon.setSingleShot(true);
  this->Soon.setInterval(0);
  this->connect(&this->Soon, &QTimer::timeout, this, &RefinePane::listSources);
  this->connect(this->Opener, &QToolButton::toggled, this, &RefinePane::open);
  this->connect(this->Editor, &RefineEditor::changed, this, &RefinePane::refresh);
  const auto soon = [this] {
    if (this->Opener->isChecked())
    {
      this->Soon.start();
    }
  };
  pqServerManagerModel* model = serverManagerModel();
  this->connect(model, &pqServerManagerModel::sourceAdded, this, soon);
  this->connect(model, &pqServerManagerModel::sourceRemoved, this, soon);
  this->connect(model, &pqServerManagerModel::nameChanged, this, soon);
  this->connect(model, &pqServerManagerModel::dataUpdated, this, soon);
  using Connection = void (pqServerManagerModel::*)(pqPipelineSource*, pqPipelineSource*, int);
  this->connect(model, static_cast<Connection>(&pqServerManagerModel::connectionAdded), this, soon);
}

void RefinePane::open(bool on)
{
  this->Opener->setChecked(on);
  this->Opener->setArrowType(on ? Qt::DownArrow : Qt::RightArrow);
  this->Body->setVisible(on);
  if (on)
  {
    this->listSources();
  }
}

void RefinePane::listSources()
{
  if (this->Deformation)
  {
    const QList<pqPipelineSource*> volumes = volumesBeside(this->Deformation);
    fill(this->Reference, {}, comparisonsOf(this->Deformation) + volumes);
    fill(this->Cavity, tr("None"), volumes);
    this->refresh();
  }
}

pqPipelineSource* RefinePane::chosen(const QComboBox* list) const
{
  pqServerManagerModel* model = serverManagerModel();
  const unsigned int id = list->currentData().toUInt();
  for (pqPipelineSource* source : model->findItems<pqPipelineSource*>())
  {
    if (id != 0 && source->getProxy()->GetGlobalID() == id)
    {
      return source;
    }
  }
  return nullptr;
}

void RefinePane::refine()
{
  if (!this->Editor)
  {
    return;
  }
  RefineSettings settings;
  settings.reference = this->chosen(this->Reference);
  settings.cavity = isComparison(settings.reference) ? nullptr : this->chosen(this->Cavity);
  settings.similarity = this->Similarity->currentIndex();
  settings.stiffness = this->Stiffness->value();
  this->Editor->begin(settings);
}

// A Compare Volumes has a cavity of its own, or none: that one counts. What was chosen here comes
// back with a reference that has none.
void RefinePane::showCavityOf(pqPipelineSource* reference)
{
  const bool hasOwn = isComparison(reference);
  this->CavityRow->setEnabled(!hasOwn);
  if (this->Cavity->count() == 0)
  {
    return;
  }
  QString text = tr("None");
  if (hasOwn)
  {
    vtkSMProxy* own = vtkSMPropertyHelper(reference->getProxy(), "Cavity").GetAsProxy();
    auto cavity = serverManagerModel()->findItem<pqPipelineSource*>(own);
    text = tr("%1 (of %2)").arg(cavity ? cavity->getSMName() : text, reference->getSMName());
    this->ChosenCavity =
      this->Cavity->currentIndex() > 0 ? this->Cavity->currentData() : this->ChosenCavity;
    this->Cavity->setCurrentIndex(0);
  }
  else if (this->ChosenCavity.isValid())
  {
    const QVariant chosen = std::exchange(this->ChosenCavity, {});
    this->Cavity->setCurrentIndex(std::max(0, this->Cavity->findData(chosen)));
  }
  this->Cavity->setItemText(0, text);
}

void RefinePane::refresh()
{
  if (!this->Editor)
  {
    return;
  }
  const bool active = this->Editor->isActive();
  const bool paused = this->Editor->state() == RefineEditor::State::Paused;
  const bool ran = active || !this->Editor->costs().isEmpty();
  this->Choices->setEnabled(!active);
  this->showCavityOf(this->chosen(this->Reference));
  this->Refine->setEnabled(!active);
  this->Pause->setEnabled(active);
  this->Pause->setText(paused ? tr("Resume") : tr("Pause"));
  this->Pause->setToolTip(paused ? tr("Continue the refinement.") : tr("Pause the refinement."));
  this->Stop->setEnabled(active);
  this->Progress->setVisible(active);
  this->Progress->setValue(static_cast<int>(WholeProgress * this->Editor->figures().done));
  this->Keep->setVisible(this->Editor->hasDiscarded());
  this->Plot->setVisible(ran && this->Editor->state() != RefineEditor::State::Idle);
  this->Plot->setCosts(this->Editor->costs());
  this->report();
}

void RefinePane::report()
{
  const RefineFigures& figures = this->Editor->figures();
  QString report;
  QString warning = this->Editor->problem();
  const QString ended =
    this->Editor->state() == RefineEditor::State::Kept ? tr("Stopped") : tr("Finished");
  switch (this->Editor->state())
  {
    case RefineEditor::State::Running:
    case RefineEditor::State::Paused:
      report = figures.steps > 0 ? refineProgress(figures) : tr("Preparing the first step ...");
      break;
    case RefineEditor::State::Kept:
    case RefineEditor::State::Finished:
      if (figures.steps == 0)
      {
        report = tr("Stopped before the first step; nothing has changed.");
        break;
      }
      if (this->Editor->hasChangedSince())
      {
        report = changedText(ended, figures.steps);
        break;
      }
      report = refineResult(ended, figures);
      warning += (warning.isEmpty() ? "" : " ") + refineWarning(figures);
      break;
    case RefineEditor::State::Idle:
      break;
  }
  showTexts(this->Report, report, this->Warning, warning);
  const QString errors = this->OfLandmarks && this->Editor->state() != RefineEditor::State::Idle &&
      !this->Editor->hasChangedSince()
    ? errorTable(this->OfLandmarks->errors(), this->OfLandmarks->note())
    : QString();
  this->Errors->setText(errors);
  this->Errors->setVisible(!errors.isEmpty());
}

// The figures of a run often appear below the panel's lower edge. If the user has scrolled away,
// the panel stays.
void RefinePane::resizeEvent(QResizeEvent* event)
{
  QWidget::resizeEvent(event);
  const bool hasMore = event->size().height() > event->oldSize().height() && this->Editor &&
    this->Editor->state() != RefineEditor::State::Idle;
  if (hasMore && !this->Opener->visibleRegion().isEmpty())
  {
    QTimer::singleShot(0, this, &RefinePane::bringIntoSight);
  }
}

void RefinePane::bringIntoSight()
{
  QWidget* above = this->parentWidget();
  while (above && !qobject_cast<QScrollArea*>(above))
  {
    above = above->parentWidget();
  }
  if (auto panel = qobject_cast<QScrollArea*>(above))
  {
    const QPoint end = this->mapTo(panel->widget(), QPoint(0, this->height()));
    panel->ensureVisible(-panel->widget()->x(), end.y(), 0, 0);
  }
}
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Properties/ResultWidget.h"

#include "Interaction/Commands/Application.h"
#include "Interaction/Displays/SharedSettings.h"
#include "Interaction/Edits/RefineEditor.h"
#include "Interaction/Edits/StrokeEditor.h"
#include "Interaction/Workarounds/Docks.h"
#include "Interaction/Workarounds/Sessions.h"
#include "Panel/Parts/Advice.h"

#include <pqPipelineSource.h>
#include <pqPropertiesPanel.h>
#include <pqUndoStack.h>

#include <vtkCommand.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMTrace.h>

#include <QCheckBox>
#include <QEvent>
#include <QFormLayout>
#include <QLabel>
#include <QVBoxLayout>

#include <algorithm>

namespace brainshift
{
namespace
{
constexpr qint64 FiguresMs = 250; // at least, from one update to the next: faster cannot be read
// A far server answers a round trip later, and the hand waits for it. So figures may take a tenth
// of a drag's time.
constexpr qint64 DragsShare = 10;

void showGraded(QLabel* label, const QString& text, Grade grade)
{
  const QColor color = gradeColor(grade, label->palette(), wantsBlueAndOrange());
  label->setText(QString("<b style=\"color:%1\">%2</b>").arg(color.name(), text.toHtmlEscaped()));
}
}

ResultWidget::ResultWidget(vtkSMProxy* proxy, vtkSMPropertyGroup* group, QWidget* parent)
  : pqPropertyGroupWidget(proxy, group, parent)
  , Source(sourceOf(proxy))
{
  auto column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(pqPropertiesPanel::suggestedVerticalSpacing());
  auto form = new QFormLayout;
  column->addLayout(form);
  form->setHorizontalSpacing(2 * pqPropertiesPanel::suggestedHorizontalSpacing());
  form->setVerticalSpacing(pqPropertiesPanel::suggestedVerticalSpacing());
  form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  this->Displacement = this->addFigure(form, "BrainShiftDisplacement", tr("Largest displacement"),
    tr("The largest displacement of a control point (mm)"));
  this->Jacobian = this->addFigure(form, "BrainShiftJacobian", tr("Tissue"), jacobianTip(1.0));
  new InSight(this);
  if (proxy->GetProperty("GuardFolding"))
  {
    this->addGuard(column);
  }

  if (vtkSMProxy* settings = sharedSettings())
  {
    this->Observers->Connect(settings->GetProperty("ComparisonColors"), vtkCommand::ModifiedEvent,
      this, SLOT(showFigures()));
  }
  this->FiguresSoon.setSingleShot(true);
  this->connect(&this->FiguresSoon, &QTimer::timeout, this, &ResultWidget::showFigures);
  this->connect(this->Source, qOverload<pqPipelineSource*>(&pqPipelineSource::dataUpdated), this,
    &ResultWidget::showFiguresSoon);
  this->connect(
    StrokeEditor::of(this->Source), &StrokeEditor::drawn, this, &ResultWidget::showFiguresSoon);
  if (RefineEditor* refine = RefineEditor::of(this->Source)) // its steps announce no new data
  {
    this->connect(refine, &RefineEditor::changed, this, &ResultWidget::showFiguresSoon);
  }
}

ResultWidget::~ResultWidget() = default;

QLabel* ResultWidget::addFigure(
  QFormLayout* form, const char* name, const QString& title, const QString& tip)
{
  auto figure = new QLabel(this);
  figure->setObjectName(name);
  figure->setToolTip(tip);
  figure->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  form->addRow(title, figure);
  form->labelForField(figure)->setToolTip(tip);
  return figure;
}

void ResultWidget::addGuard(QVBoxLayout* column)
{
  this->Guard = new QCheckBox(tr("Guard against folding"), this);
  this->Guard->setObjectName("BrainShiftGuard");
  this->Guard->setToolTip(
    tr("Shorten each stroke so that all tissue keeps at least 10 % of its volume. (The Jacobian "
       "determinant stays at 0.1 or above everywhere.)"));
  this->Shortened = new QLabel(this);
  this->Shortened->setObjectName("BrainShiftShortened");
  this->Shortened->setWordWrap(true);
  column->addWidget(this->Guard);
  column->addWidget(this->Shortened);
  this->connect(this->Guard, &QCheckBox::clicked, this, &ResultWidget::setGuard);
  this->Observers->Connect(
    this->proxy()->GetProperty("GuardFolding"), vtkCommand::ModifiedEvent, this, SLOT(showGuard()));
  this->showGuard();
}

void ResultWidget::setGuard(bool on)
{
  {
    SCOPED_UNDO_SET(tr("Guard Against Folding"));
    SM_SCOPED_TRACE(PropertiesModified).arg("proxy", this->proxy());
    vtkSMPropertyHelper(this->proxy(), "GuardFolding").Set(on);
    this->proxy()->UpdateVTKObjects();
  }
  this->Source->renderAllViews();
}

void ResultWidget::showGuard()
{
  this->Guard->setChecked(vtkSMPropertyHelper(this->proxy(), "GuardFolding").GetAsInt() != 0);
}

double ResultWidget::figure(const char* property) const
{
  return vtkSMPropertyHelper(this->proxy(), property).GetAsDouble();
}

void ResultWidget::showFiguresSoon()
{
  if (!this->isVisible())
  {
    return;
  }
  const RefineEditor* refine = RefineEditor::of(this->Source);
  const bool moves = StrokeEditor::of(this->Source)->isEditing() || (refine && refine->isActive());
  const qint64 pause = moves ? std::max(FiguresMs, DragsShare * this->FiguresTookMs) : FiguresMs;
  const qint64 passed = this->SinceFigures.isValid() ? this->SinceFigures.elapsed() : pause;
  const int wait = static_cast<int>(std::max<qint64>(pause - passed, 0));
  if (!this->FiguresSoon.isActive() || wait < this->FiguresSoon.remainingTime())
  {
    this->FiguresSoon.start(wait);
  }
}

void ResultWidget::showFigures()
{
  this->SinceFigures.start();
  if (this->Source->modifiedState() == pqProxy::UNINITIALIZED) // not applied yet
  {
    this->Displacement->setText(tr("not applied yet"));
    this->Jacobian->setText(QString());
    return;
  }
  pull(this->proxy()); // all figures in one round trip to a server
  this->Displacement->setText(
    tr("<b>%1 mm</b>").arg(this->figure("MaximumDisplacement"), 0, 'f', 1));
  const double determinant = this->figure("MinimumJacobian");
  showGraded(this->Jacobian, jacobianText(determinant), jacobianGrade(determinant));
  this->Jacobian->setToolTip(jacobianTip(determinant));
  if (this->Guard)
  {
    const QString advice = guardAdvice(static_cast<int>(this->figure("ShortenedStrokes")));
    showGraded(this->Shortened, advice, Grade::Doubtful);
    this->Shortened->setVisible(!advice.isEmpty());
  }
  this->FiguresTookMs = this->SinceFigures.elapsed();
}

void ResultWidget::changeEvent(QEvent* event)
{
  this->pqPropertyGroupWidget::changeEvent(event);
  if (event->type() == QEvent::PaletteChange)
  {
    this->showFiguresSoon();
  }
}

void ResultWidget::showEvent(QShowEvent* event)
{
  this->pqPropertyGroupWidget::showEvent(event);
  this->showFigures();
}
}

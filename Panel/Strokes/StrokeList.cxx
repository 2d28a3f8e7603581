// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Strokes/StrokeList.h"

#include "Interaction/Displays/SharedSettings.h"
#include "Panel/Parts/Advice.h"
#include "Panel/Parts/ListTree.h"
#include "Panel/Strokes/StrokeModel.h"

#include <QApplication>
#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>
#include <QVBoxLayout>

namespace brainshift
{
StrokeList::StrokeList(StrokeModel* model, QWidget* parent)
  : QWidget(parent)
  , Strokes(model)
  , Tree(new ListTree(model,
      { 4, 9, tr("There are no strokes yet. Choose a tool, then work on the volume in the view.") },
      this))
  , Problem(new QLabel(this))
  , Delete(new QToolButton(this))
  , Reset(new QToolButton(this))
{
  this->setObjectName("List");
  this->Tree->setObjectName("BrainShiftStrokes");
  this->Tree->setAccessibleName(tr("Strokes"));
  this->Problem->setObjectName("BrainShiftProblem");
  this->Problem->setWordWrap(true);
  this->Delete->setObjectName("BrainShiftDelete");
  this->Delete->setText(tr("Delete"));
  this->Delete->setIcon(QIcon(":/BrainShift/delete.svg"));
  this->Delete->setToolTip(
    tr("Delete the selected strokes (Delete key). Ctrl+Z brings them back."));
  this->Reset->setObjectName("BrainShiftReset");
  this->Reset->setText(tr("Reset All"));
  this->Reset->setIcon(QIcon(":/BrainShift/reset.svg"));
  this->Reset->setToolTip(tr("Delete all strokes. Ctrl+Z brings them back."));

  auto buttons = new QHBoxLayout;
  for (QToolButton* button : { this->Delete, this->Reset })
  {
    button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    button->setFocusPolicy(Qt::TabFocus); // a click leaves the keyboard where it is
    buttons->addWidget(button);
    this->connect(button, &QToolButton::pressed, this, &StrokeList::giveFocusBack);
  }
  buttons->addStretch();
  auto column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(this->Problem);
  column->addWidget(this->Tree);
  column->addLayout(buttons);

  this->connect(this->Delete, &QToolButton::clicked, this->Tree, &ListTree::removeSelected);
  this->connect(this->Reset, &QToolButton::clicked, model, &StrokeModel::removeAll);
  this->connect(this->Tree, &ListTree::selectedRowsChanged, this, &StrokeList::refresh);
  this->connect(model, &StrokeModel::updated, this, &StrokeList::refresh);
  this->connect(qApp, &QApplication::focusChanged, this, [this](QWidget* before, QWidget* now) {
    this->FocusBefore = now && now->isAncestorOf(this) ? before : nullptr;
  });
  this->refresh();
}

void StrokeList::refresh()
{
  const QString& problem = this->Strokes->problem();
  this->Problem->setText(problem);
  this->Problem->setVisible(!problem.isEmpty());
  QPalette palette = this->palette();
  palette.setColor(QPalette::WindowText, gradeColor(Grade::Bad, palette, wantsBlueAndOrange()));
  this->Problem->setPalette(palette);
  this->enable(this->Delete, !this->Tree->selectedRows().isEmpty());
  this->enable(this->Reset, this->Strokes->rowCount() > 0 || !problem.isEmpty());
}

// Qt offers a click that the button does not want the focus for to the panel around it.
void StrokeList::giveFocusBack()
{
  QWidget* focus = QApplication::focusWidget();
  if (this->FocusBefore && focus && focus->isAncestorOf(this))
  {
    this->FocusBefore->setFocus();
  }
}

// Qt takes the focus from a button that is disabled to whatever comes next in the panel.
void StrokeList::enable(QToolButton* button, bool enabled)
{
  if (!enabled && button->hasFocus())
  {
    this->Tree->setFocus();
  }
  button->setEnabled(enabled);
}
}

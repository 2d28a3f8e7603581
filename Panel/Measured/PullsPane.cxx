// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Measured/PullsPane.h"

#include "Interaction/Commands/ToolSettings.h"
#include "Interaction/Edits/FitEditor.h"
#include "Panel/Measured/PullModel.h"
#include "Panel/Parts/ListTree.h"

#include <pqPipelineSource.h>
#include <pqProxyWidget.h>

#include <vtkSMSourceProxy.h>

#include <QHBoxLayout>
#include <QToolButton>
#include <QVBoxLayout>

namespace brainshift
{
namespace
{
constexpr int ListMs = 250; // from one update of a list under the hand to the next

PullModel* makeModel(const QPointer<FitEditor>& editor, QObject* parent)
{
  return new PullModel(
    [editor](const Pulled& pulled, const QString& label) {
      if (editor)
      {
        editor->edit(label, [&pulled](vtkSMProxy* fit) {
          FitEditor::setNumbers(fit, "Pulls", numbersFrom(pulled.pulls));
          FitEditor::setNumbers(fit, "Pins", numbersFrom(pulled.pins));
        });
      }
    },
    parent);
}
}

PullsPane::PullsPane(pqPipelineSource* deformation, QWidget* parent)
  : QWidget(parent)
  , Editor(FitEditor::of(deformation))
  , Pulls(makeModel(this->Editor, this))
  , Tree(new ListTree(this->Pulls, { 2, 7, tr("There are no pulls or pins.") }, this))
  , Delete(new QToolButton(this))
  , Clear(new QToolButton(this))
{
  this->setObjectName("Pulls");
  this->Tree->setObjectName("BrainShiftPulls");
  this->Tree->setAccessibleName(tr("Pulls and pins"));
  this->Delete->setObjectName("BrainShiftDeletePulls");
  this->Delete->setText(tr("Delete"));
  this->Delete->setIcon(QIcon(":/BrainShift/delete.svg"));
  this->Delete->setToolTip(
    tr("Delete the selected pulls and pins (Delete key). Ctrl+Z brings them back."));
  this->Clear->setObjectName("BrainShiftClearPulls");
  this->Clear->setText(tr("Clear All"));
  this->Clear->setIcon(QIcon(":/BrainShift/reset.svg"));
  this->Clear->setToolTip(tr("Delete all pulls and pins. Ctrl+Z brings them back."));
  auto buttons = new QHBoxLayout;
  for (QToolButton* button : { this->Delete, this->Clear })
  {
    button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    button->setFocusPolicy(Qt::TabFocus); // a click leaves the keyboard where it is
    buttons->addWidget(button);
  }
  buttons->addStretch();
  auto column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(pqProxyWidget::newGroupLabelWidget(tr("Pulls and Pins (mm)"), this));
  column->addWidget(this->Tree);
  column->addLayout(buttons);

  this->Soon.setSingleShot(true);
  this->connect(&this->Soon, &QTimer::timeout, this, &PullsPane::update);
  this->connect(this->Delete, &QToolButton::clicked, this->Tree, &ListTree::removeSelected);
  this->connect(this->Clear, &QToolButton::clicked, this->Pulls, &PullModel::removeAll);
  this->connect(this->Tree, &ListTree::selectedRowsChanged, this, &PullsPane::refresh);
  this->connect(this->Editor, &FitEditor::changed, this, &PullsPane::followPulls);
  this->connect(ToolSettings::instance(), &ToolSettings::changed, this, &PullsPane::refresh);
  this->connect(deformation, qOverload<pqPipelineSource*>(&pqPipelineSource::dataUpdated), this,
    &PullsPane::followResult);
  this->update();
}

void PullsPane::followPulls()
{
  // Painting numbers takes its time from a drag.
  if (!this->Soon.isActive())
  {
    this->Soon.start(this->Editor->isEditing() ? ListMs : 0);
  }
}

void PullsPane::update()
{
  if (this->Editor)
  {
    this->Pulls->show({ rowsFrom<Pull>(this->Editor->numbers("Pulls")),
      rowsFrom<Pin>(this->Editor->numbers("Pins")) });
    if (this->Editor->isEditing())
    {
      this->Pulls->setPlaces({}); // those of a moment ago: nothing is missed by that
    }
    this->refresh();
  }
}

void PullsPane::followResult()
{
  this->update();
  if (!this->Editor)
  {
    return;
  }
  std::vector<glm::dvec3> rest;
  std::vector<glm::dvec3> pinned;
  for (const Pull& pull : this->Pulls->pulled().pulls)
  {
    rest.push_back(pull.rest);
  }
  for (const Pin& pin : this->Pulls->pulled().pins)
  {
    pinned.push_back(pin.rest);
  }
  rest.insert(rest.end(), pinned.begin(), pinned.end());
  this->Pulls->setPlaces(this->Editor->fittedPlaces(rest), this->Editor->basePlaces(pinned));
}

void PullsPane::refresh()
{
  // A fit of landmarks or traces alone needs no empty list.
  const Tool tool = ToolSettings::instance()->tool();
  const bool makesPulls = tool != Tool::None && shapeOf(tool) == StrokeShape::None;
  const bool wanted = this->Pulls->rowCount() > 0 || makesPulls;
  this->setVisible(wanted && this->Editor && this->Editor->fit());
  this->Delete->setEnabled(!this->Tree->selectedRows().isEmpty());
  this->Clear->setEnabled(this->Pulls->rowCount() > 0);
}
}

// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Measured/PullsPane.h"

#include "Interaction/Commands/ToolSettings.h"
#include "Interaction/Edits/FitEditor.h"

#include <pqPipelineSource.h>
#include <pqProxyWidget.h>

#include <QHBoxLayout>
#include <QToolButton>
#include <QVBoxLayout>

namespace brainshift
{
namespace
{
constexpr double LeastAsked = 0.01; // mm; at 0 a pull would lose its direction
constexpr double MostAsked = 1000.0;
constexpr double LeastWeight = 0.01; // at 0 a pull is switched off
constexpr double MostWeight = 100.0;

double askedOf(const Pull& pull)
{
  return glm::distance(pull.rest, pull.measured);
}
}

PullModel::PullModel(Write write, std::shared_ptr<FormerWeights> weights, QObject* parent)
  : ListModel(
      {
        { tr("Tissue"), tr("A pull or a pin. The check mark includes it in the fit."), true },
        { tr("Requested"), tr("Distance from the position in the scan to the target (mm)") },
        { tr("Residual"),
          tr("Distance from the target to the position after the fit (mm). All pulls and pins are "
             "solved together.") },
        { tr("Weight"),
          tr("Confidence in the pull. The default is 1. A weight of 4 halves the standard "
             "deviation of the pull.") },
        { tr("Position"), tr("Position of the tissue in the scan: x, y, z (mm, world axes)"),
          true },
      },
      parent)
  , WritePulled(std::move(write))
  , Weights(std::move(weights))
{
}

const Pin& PullModel::pin(int row) const
{
  return this->Now.pins[static_cast<std::size_t>(row) - this->Now.pulls.size()];
}

void PullModel::show(const Pulled& pulled)
{
  const int before = this->count();
  this->Now = pulled;
  if (this->count() != before)
  {
    this->Places.clear();
  }
  this->announce();
}

void PullModel::setPlaces(
  const std::vector<glm::dvec3>& places, const std::vector<glm::dvec3>& held)
{
  this->Places = places;
  this->Held = held;
  this->announceColumn(MissedColumn);
}

bool PullModel::isOn(int row) const
{
  return this->isPull(row) ? this->pull(row).weight > 0.0 : this->pin(row).enabled;
}

void PullModel::setOn(const QList<int>& rows, bool on)
{
  Pulled changed = this->Now;
  for (const int row : rows)
  {
    if (!this->isPull(row))
    {
      changed.pins.at(static_cast<std::size_t>(row) - changed.pulls.size()).enabled = on;
    }
    else
    {
      this->Weights->setOn(changed.pulls.at(static_cast<std::size_t>(row)), on);
    }
  }
  this->WritePulled(changed, on ? tr("Switch On Pulls") : tr("Switch Off Pulls"));
}

void PullModel::removeRowsOf(const QList<int>& rows)
{
  Pulled left;
  for (int row = 0; row < this->count(); ++row)
  {
    if (rows.contains(row))
    {
      continue;
    }
    if (this->isPull(row))
    {
      left.pulls.push_back(this->pull(row));
    }
    else
    {
      left.pins.push_back(this->pin(row));
    }
  }
  this->WritePulled(left, tr("Delete Pulls"));
}

void PullModel::removeAll()
{
  this->WritePulled({}, tr("Clear All Pulls"));
}

int PullModel::count() const
{
  return static_cast<int>(this->Now.pulls.size() + this->Now.pins.size());
}

std::optional<ListModel::Number> PullModel::number(int row, int column) const
{
  if (!this->isPull(row))
  {
    return std::nullopt;
  }
  if (column == WeightColumn)
  {
    return Number{ this->pull(row).weight, LeastWeight, MostWeight };
  }
  const double asked = askedOf(this->pull(row));
  return column == AskedColumn && asked > 0.0
    ? std::optional<Number>({ asked, LeastAsked, MostAsked })
    : std::nullopt;
}

void PullModel::change(int row, int column, double number)
{
  Pulled changed = this->Now;
  Pull& pull = changed.pulls.at(static_cast<std::size_t>(row));
  if (column == WeightColumn)
  {
    pull.weight = number;
  }
  else
  {
    pull.measured = pull.rest + number * glm::normalize(pull.measured - pull.rest);
  }
  this->WritePulled(changed, tr("Change Pull"));
}

// Where the tissue of a row should be, mm.
glm::dvec3 PullModel::target(int row) const
{
  if (this->isPull(row))
  {
    return this->pull(row).measured;
  }
  const std::size_t place = static_cast<std::size_t>(row) - this->Now.pulls.size();
  return place < this->Held.size() ? this->Held[place] : this->pin(row).rest;
}

QString PullModel::text(int row, int column) const
{
  const std::size_t place = static_cast<std::size_t>(row);
  const glm::dvec3& rest = this->isPull(row) ? this->pull(row).rest : this->pin(row).rest;
  switch (column)
  {
    case KindColumn:
      return this->isPull(row)
        ? tr("Pull %1").arg(row + 1)
        : tr("Pin %1").arg(row + 1 - static_cast<int>(this->Now.pulls.size()));
    case AskedColumn:
      return this->isPull(row) ? QString::number(askedOf(this->pull(row)), 'f', 1) : tr("stays");
    case MissedColumn:
    {
      return this->isOn(row) && place < this->Places.size()
        ? QString::number(glm::distance(this->Places[place], this->target(row)), 'f', 1)
        : QString();
    }
    case WeightColumn:
      return this->isPull(row) ? QString::number(this->pull(row).weight) : QString();
    default:
      return positionText(rest, 0);
  }
}

QString PullModel::toolTip(int row, int) const
{
  const QString tip = this->isPull(row)
    ? tr("Pull from %1 to %2 mm")
        .arg(positionText(this->pull(row).rest, 2), positionText(this->pull(row).measured, 2))
    : tr("Pin at %1 mm").arg(positionText(this->pin(row).rest, 2));
  return this->isOn(row) ? tip : tip + tr(" (switched off)");
}

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
          setNumbers(fit, "Pulls", numbersFrom(pulled.pulls));
          setNumbers(fit, "Pins", numbersFrom(pulled.pins));
        });
      }
    },
    editor ? editor->formerWeights() : std::make_shared<FormerWeights>(), parent);
}
}

PullsPane::PullsPane(pqPipelineSource* deformation, QWidget* parent)
  : QWidget(parent)
  , Editor(FitEditor::of(deformation))
  , Pulls(makeModel(this->Editor, this))
  , Tree(new ListTree(this->Pulls, { 2, 7, tr("There are no pulls or pins.") }, this))
  , Delete(makeListButton(this, "BrainShiftDeletePulls", tr("Delete"),
      tr("Delete the selected pulls and pins (Delete key). Ctrl+Z brings them back."),
      ":/BrainShift/delete.svg"))
  , Clear(makeListButton(this, "BrainShiftClearPulls", tr("Clear All"),
      tr("Delete all pulls and pins. Ctrl+Z brings them back."), ":/BrainShift/reset.svg"))
{
  this->setObjectName("Pulls");
  this->Tree->setObjectName("BrainShiftPulls");
  this->Tree->setAccessibleName(tr("Pulls and pins"));
  auto buttons = new QHBoxLayout;
  buttons->addWidget(this->Delete);
  buttons->addWidget(this->Clear);
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
  this->Pulls->setPlaces(this->Editor->fittedPositions(rest), this->Editor->basePositions(pinned));
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

// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Measured/PullModel.h"

#include "Panel/Parts/NumberDelegate.h"

#include <QGuiApplication>
#include <QPalette>

#include <glm/geometric.hpp>

#include <algorithm>
#include <utility>

namespace brainshift
{
namespace
{
constexpr double LeastAsked = 0.01; // mm; at 0 a pull would lose its direction
constexpr double MostAsked = 1000.0;
constexpr double LeastWeight = 0.01; // at 0 a pull is switched off
constexpr double MostWeight = 100.0;

QString textOf(const glm::dvec3& position, int decimals)
{
  return QString("%1, %2, %3")
    .arg(position.x, 0, 'f', decimals)
    .arg(position.y, 0, 'f', decimals)
    .arg(position.z, 0, 'f', decimals);
}

double askedOf(const Pull& pull)
{
  return glm::distance(pull.rest, pull.target);
}

int sideOf(int column)
{
  const bool isText = column == PullModel::KindColumn || column == PullModel::WhereColumn;
  return int(isText ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter;
}
}

PullModel::PullModel(Write write, QObject* parent)
  : QAbstractTableModel(parent)
  , WritePulled(std::move(write))
{
}

const Pin& PullModel::pin(int row) const
{
  return this->Now.pins[static_cast<std::size_t>(row) - this->Now.pulls.size()];
}

void PullModel::show(const Pulled& pulled)
{
  const int before = this->rowCount();
  const int rows = static_cast<int>(pulled.pulls.size() + pulled.pins.size());
  if (rows > before)
  {
    this->beginInsertRows({}, before, rows - 1);
    this->Now = pulled;
    this->endInsertRows();
  }
  else if (rows < before)
  {
    this->beginRemoveRows({}, rows, before - 1);
    this->Now = pulled;
    this->endRemoveRows();
  }
  this->Now = pulled;
  if (rows != before)
  {
    this->Places.clear();
  }
  if (rows > 0)
  {
    Q_EMIT this->dataChanged(this->index(0, 0), this->index(rows - 1, ColumnCount - 1));
  }
}

void PullModel::setPlaces(
  const std::vector<glm::dvec3>& places, const std::vector<glm::dvec3>& held)
{
  this->Places = places;
  this->Held = held;
  if (this->rowCount() > 0)
  {
    Q_EMIT this->dataChanged(
      this->index(0, MissedColumn), this->index(this->rowCount() - 1, MissedColumn));
  }
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
    else if (this->isOn(row) != on)
    {
      changed.pulls.at(static_cast<std::size_t>(row)).weight = on ? 1.0 : 0.0;
    }
  }
  this->WritePulled(changed, on ? tr("Switch On Pulls") : tr("Switch Off Pulls"));
}

void PullModel::removeRowsOf(const QList<int>& rows)
{
  Pulled left;
  for (int row = 0; row < this->rowCount(); ++row)
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

int PullModel::rowCount(const QModelIndex& parent) const
{
  return parent.isValid() ? 0 : static_cast<int>(this->Now.pulls.size() + this->Now.pins.size());
}

int PullModel::columnCount(const QModelIndex& parent) const
{
  return parent.isValid() ? 0 : ColumnCount;
}

Qt::ItemFlags PullModel::flags(const QModelIndex& index) const
{
  Qt::ItemFlags flags = Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemNeverHasChildren;
  if (index.column() == KindColumn)
  {
    flags |= Qt::ItemIsUserCheckable;
  }
  const bool isNumber = index.column() == AskedColumn || index.column() == WeightColumn;
  if (isNumber && this->isPull(index.row()) &&
    (index.column() == WeightColumn || askedOf(this->pull(index.row())) > 0.0))
  {
    flags |= Qt::ItemIsEditable;
  }
  return flags;
}

QVariant PullModel::headerData(int section, Qt::Orientation orientation, int role) const
{
  static const char* const titles[ColumnCount] = { QT_TR_NOOP("Tissue"), QT_TR_NOOP("Asked"),
    QT_TR_NOOP("Missed by"), QT_TR_NOOP("Weight"), QT_TR_NOOP("Position") };
  static const char* const tips[ColumnCount] = {
    QT_TR_NOOP("A pull or a pin. The check mark switches it on."),
    QT_TR_NOOP("How far the hand took the tissue from where it was in the scan (mm)"),
    QT_TR_NOOP("How far from there the fit leaves the tissue (mm). All is solved together."),
    QT_TR_NOOP("How far the pull is trusted: 1 as usual, 4 twice as closely"),
    QT_TR_NOOP("Where the tissue was in the scan: x, y, z (mm, world axes)"),
  };
  if (orientation != Qt::Horizontal)
  {
    return {};
  }
  switch (role)
  {
    case Qt::DisplayRole:
      return tr(titles[section]);
    case Qt::ToolTipRole:
      return tr(tips[section]);
    case Qt::TextAlignmentRole:
      return sideOf(section);
    default:
      return {};
  }
}

// Where the tissue of a row should be, mm.
glm::dvec3 PullModel::target(int row) const
{
  if (this->isPull(row))
  {
    return this->pull(row).target;
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
      return textOf(rest, 0);
  }
}

QString PullModel::toolTip(int row) const
{
  const QString tip = this->isPull(row)
    ? tr("Pull from %1 to %2 mm")
        .arg(textOf(this->pull(row).rest, 2), textOf(this->pull(row).target, 2))
    : tr("Pin at %1 mm").arg(textOf(this->pin(row).rest, 2));
  return this->isOn(row) ? tip : tip + tr(" (switched off)");
}

QVariant PullModel::data(const QModelIndex& index, int role) const
{
  const int row = index.row();
  const int column = index.column();
  if (!this->checkIndex(index, CheckIndexOption::IndexIsValid))
  {
    return {};
  }
  const bool isAsked = column == AskedColumn;
  switch (role)
  {
    case Qt::DisplayRole:
      return this->text(row, column);
    case Qt::EditRole:
      return !(this->flags(index) & Qt::ItemIsEditable)
        ? QVariant()
        : QVariant(isAsked ? askedOf(this->pull(row)) : this->pull(row).weight);
    case Qt::CheckStateRole:
      return column == KindColumn ? QVariant(this->isOn(row) ? Qt::Checked : Qt::Unchecked)
                                  : QVariant();
    case Qt::ToolTipRole:
      return this->toolTip(row);
    case Qt::TextAlignmentRole:
      return sideOf(column);
    case Qt::ForegroundRole:
      return this->isOn(row) ? QVariant()
                             : QGuiApplication::palette().brush(QPalette::Disabled, QPalette::Text);
    case NumberDelegate::LeastRole:
      return isAsked ? LeastAsked : LeastWeight;
    case NumberDelegate::MostRole:
      return isAsked ? MostAsked : MostWeight;
    default:
      return {};
  }
}

bool PullModel::setData(const QModelIndex& index, const QVariant& value, int role)
{
  if (!this->checkIndex(index, CheckIndexOption::IndexIsValid))
  {
    return false;
  }
  if (role == Qt::CheckStateRole && index.column() == KindColumn)
  {
    this->setOn({ index.row() }, value.toInt() == Qt::Checked);
    return true;
  }
  bool isNumber = false;
  const double number = value.toDouble(&isNumber);
  if (role != Qt::EditRole || !isNumber || !(this->flags(index) & Qt::ItemIsEditable) ||
    !(number >= this->data(index, NumberDelegate::LeastRole).toDouble() &&
      number <= this->data(index, NumberDelegate::MostRole).toDouble()))
  {
    return false;
  }
  if (number == this->data(index, Qt::EditRole).toDouble())
  {
    return true; // an editor that was opened and closed is no edit
  }
  Pulled changed = this->Now;
  Pull& pull = changed.pulls.at(static_cast<std::size_t>(index.row()));
  if (index.column() == WeightColumn)
  {
    pull.weight = number;
  }
  else
  {
    pull.target = pull.rest + number * glm::normalize(pull.target - pull.rest);
  }
  this->WritePulled(changed, tr("Change Pull"));
  return true;
}
}

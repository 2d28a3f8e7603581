// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Parts/ListModel.h"

#include <QFont>
#include <QGuiApplication>
#include <QIcon>
#include <QPalette>

namespace brainshift
{
QString positionText(const glm::dvec3& position, int decimals)
{
  return QString("%1, %2, %3")
    .arg(position.x, 0, 'f', decimals)
    .arg(position.y, 0, 'f', decimals)
    .arg(position.z, 0, 'f', decimals);
}

ListModel::ListModel(const QList<Column>& columns, QObject* parent)
  : QAbstractTableModel(parent)
  , Columns(columns)
{
}

int ListModel::whereColumn() const
{
  const int last = static_cast<int>(this->Columns.size()) - 1;
  return last > 0 && this->Columns[last].isText ? last : -1;
}

QString ListModel::warning(int, int) const
{
  return {};
}

bool ListModel::isBold(int) const
{
  return false;
}

std::optional<ListModel::Number> ListModel::number(int, int) const
{
  return std::nullopt;
}

void ListModel::change(int, int, double) {}

void ListModel::announce()
{
  const int rows = this->count();
  if (rows > this->Rows)
  {
    this->beginInsertRows({}, this->Rows, rows - 1);
    this->Rows = rows;
    this->endInsertRows();
  }
  else if (rows < this->Rows)
  {
    this->beginRemoveRows({}, rows, this->Rows - 1);
    this->Rows = rows;
    this->endRemoveRows();
  }
  if (rows > 0)
  {
    Q_EMIT this->dataChanged(this->index(0, 0), this->index(rows - 1, this->columnCount() - 1));
  }
}

void ListModel::announceColumn(int column)
{
  if (this->Rows > 0)
  {
    Q_EMIT this->dataChanged(this->index(0, column), this->index(this->Rows - 1, column));
  }
}

int ListModel::rowCount(const QModelIndex& parent) const
{
  return parent.isValid() ? 0 : this->Rows;
}

int ListModel::columnCount(const QModelIndex& parent) const
{
  return parent.isValid() ? 0 : static_cast<int>(this->Columns.size());
}

Qt::ItemFlags ListModel::flags(const QModelIndex& index) const
{
  Qt::ItemFlags flags = Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemNeverHasChildren;
  flags.setFlag(Qt::ItemIsUserCheckable, index.column() == 0);
  const bool isThere = index.isValid() && index.row() < this->count();
  flags.setFlag(Qt::ItemIsEditable, isThere && this->number(index.row(), index.column()));
  return flags;
}

QVariant ListModel::headerData(int section, Qt::Orientation orientation, int role) const
{
  if (orientation != Qt::Horizontal || section < 0 || section >= this->columnCount())
  {
    return {};
  }
  const Column& column = this->Columns[section];
  switch (role)
  {
    case Qt::DisplayRole:
      return column.title;
    case Qt::ToolTipRole:
      return column.tip;
    case Qt::TextAlignmentRole:
      return int(column.isText ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter;
    default:
      return {};
  }
}

QVariant ListModel::number(const QModelIndex& index, int role) const
{
  const std::optional<Number> number = this->number(index.row(), index.column());
  if (!number)
  {
    return {};
  }
  return role == LeastRole ? number->least : role == MostRole ? number->most : number->value;
}

QVariant ListModel::data(const QModelIndex& index, int role) const
{
  const int row = index.row();
  const int column = index.column();
  if (!index.isValid() || row >= this->count()) // the list may be ahead of the views
  {
    return {};
  }
  switch (role)
  {
    case Qt::DisplayRole:
      return this->text(row, column);
    case Qt::CheckStateRole:
      return column == 0 ? QVariant(this->isOn(row) ? Qt::Checked : Qt::Unchecked) : QVariant();
    case Qt::DecorationRole:
      return this->warning(row, column).isEmpty() ? QVariant() : QIcon(":/BrainShift/warning.svg");
    case Qt::ToolTipRole:
    {
      const QString warning = this->warning(row, column);
      return warning.isEmpty() ? this->toolTip(row, column) : warning;
    }
    case Qt::TextAlignmentRole:
      return this->headerData(column, Qt::Horizontal, role);
    case Qt::ForegroundRole:
      return this->isOn(row) ? QVariant()
                             : QGuiApplication::palette().brush(QPalette::Disabled, QPalette::Text);
    case Qt::FontRole:
    {
      QFont font = QGuiApplication::font();
      font.setBold(true);
      return this->isBold(row) ? QVariant(font) : QVariant();
    }
    case Qt::EditRole:
    case LeastRole:
    case MostRole:
      return this->number(index, role);
    default:
      return {};
  }
}

bool ListModel::setData(const QModelIndex& index, const QVariant& value, int role)
{
  const int row = index.row();
  const int column = index.column();
  if (!this->checkIndex(index, CheckIndexOption::IndexIsValid) || row >= this->count())
  {
    return false;
  }
  if (role == Qt::CheckStateRole && column == 0)
  {
    this->setOn({ row }, value.toInt() == Qt::Checked);
    return true;
  }
  bool isNumber = false;
  const double wanted = value.toDouble(&isNumber);
  const std::optional<Number> before = this->number(row, column);
  if (role != Qt::EditRole || !isNumber || !before ||
    !(wanted >= before->least && wanted <= before->most))
  {
    return false;
  }
  if (wanted != before->value) // an editor that was opened and closed is no edit
  {
    this->change(row, column, wanted);
  }
  return true;
}
}

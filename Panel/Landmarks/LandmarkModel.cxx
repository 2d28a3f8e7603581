// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Landmarks/LandmarkModel.h"

#include "Interaction/Landmarks/LandmarkList.h"

#include <QFont>
#include <QGuiApplication>
#include <QIcon>
#include <QPalette>

#include <cmath>

namespace brainshift
{
namespace
{
QString millimetres(double value)
{
  return std::isfinite(value) ? QString::number(value, 'f', 2) : QString(QChar(0x2013));
}

QString positionText(const glm::dvec3& at)
{
  return QString("%1, %2, %3").arg(at.x, 0, 'f', 1).arg(at.y, 0, 'f', 1).arg(at.z, 0, 'f', 1);
}
}

LandmarkModel::LandmarkModel(LandmarkList* list, QObject* parent)
  : QAbstractTableModel(parent)
  , List(list)
{
  this->connect(list, &LandmarkList::changed, this, &LandmarkModel::update);
  this->update();
}

void LandmarkModel::update()
{
  const int rows = this->List ? static_cast<int>(this->List->rows().size()) : 0;
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
    Q_EMIT this->dataChanged(this->index(0, 0), this->index(rows - 1, ColumnCount - 1));
  }
}

int LandmarkModel::rowCount(const QModelIndex& parent) const
{
  return parent.isValid() ? 0 : this->Rows;
}

int LandmarkModel::columnCount(const QModelIndex& parent) const
{
  return parent.isValid() ? 0 : ColumnCount;
}

Qt::ItemFlags LandmarkModel::flags(const QModelIndex& index) const
{
  const Qt::ItemFlags flags = Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemNeverHasChildren;
  return index.column() == NameColumn ? flags | Qt::ItemIsUserCheckable : flags;
}

QVariant LandmarkModel::headerData(int section, Qt::Orientation orientation, int role) const
{
  static const char* const titles[ColumnCount] = { QT_TR_NOOP("Landmark"), QT_TR_NOOP("Residual"),
    QT_TR_NOOP("Left out") };
  static const char* const tips[ColumnCount] = {
    QT_TR_NOOP("Number, and name if a file gives one. The check mark lets the pair count."),
    QT_TR_NOOP("How far from its measured place the fit puts the landmark (mm)"),
    QT_TR_NOOP("How far a fit without this pair misses it (mm), before fold guard and mask. A pair "
               "that is switched off is left out already: this is how far the fit misses it."),
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
      return int(section == NameColumn ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter;
    default:
      return {};
  }
}

bool LandmarkModel::isWorst(int row) const
{
  return this->List->figures().worst == row;
}

QString LandmarkModel::text(int row, int column) const
{
  const LandmarkRow& landmark = this->List->rows()[row];
  switch (column)
  {
    case ResidualColumn:
      return millimetres(landmark.residual);
    case LeftOutColumn:
      return millimetres(landmark.leftOut);
    default:
      // A name that is only the number says nothing new.
      return landmark.name.isEmpty() || landmark.name == QString::number(row + 1)
        ? QString::number(row + 1)
        : tr("%1 %2").arg(row + 1).arg(landmark.name);
  }
}

QString LandmarkModel::toolTip(int row, int column) const
{
  const LandmarkRow& landmark = this->List->rows()[row];
  if (this->isWorst(row))
  {
    return tr("This pair fits worst: a fit without it misses it by %1 mm. Check it, or switch it "
              "off.")
      .arg(millimetres(landmark.leftOut));
  }
  if (!landmark.on && column == LeftOutColumn)
  {
    return tr("Switched off. The fit of the other pairs misses it by %1 mm.")
      .arg(millimetres(landmark.leftOut));
  }
  return tr("At rest %1 mm, measured %2 mm. %3")
    .arg(positionText(landmark.rest), positionText(landmark.measured),
      landmark.isPicked() ? tr("Picked in the window.") : tr("From a file."));
}

QVariant LandmarkModel::data(const QModelIndex& index, int role) const
{
  const int row = index.row();
  if (!this->List || row < 0 || row >= static_cast<int>(this->List->rows().size()))
  {
    return {}; // the list is ahead of the model
  }
  const LandmarkRow& landmark = this->List->rows()[row];
  const bool isName = index.column() == NameColumn;
  switch (role)
  {
    case Qt::DisplayRole:
      return this->text(row, index.column());
    case Qt::CheckStateRole:
      return isName ? QVariant(landmark.on ? Qt::Checked : Qt::Unchecked) : QVariant();
    case Qt::DecorationRole:
      return index.column() == LeftOutColumn && this->isWorst(row)
        ? QVariant(QIcon(":/BrainShift/warning.svg"))
        : QVariant();
    case Qt::FontRole:
    {
      QFont font = QGuiApplication::font();
      font.setBold(this->isWorst(row));
      return font;
    }
    case Qt::ToolTipRole:
      return this->toolTip(row, index.column());
    case Qt::TextAlignmentRole:
      return this->headerData(index.column(), Qt::Horizontal, role);
    case Qt::ForegroundRole:
      return landmark.on ? QVariant() : QGuiApplication::palette().brush(QPalette::PlaceholderText);
    default:
      return {};
  }
}

bool LandmarkModel::setData(const QModelIndex& index, const QVariant& value, int role)
{
  if (role != Qt::CheckStateRole || index.column() != NameColumn || !this->List ||
    index.row() >= static_cast<int>(this->List->rows().size()))
  {
    return false;
  }
  this->List->setOn({ index.row() }, value.toInt() == Qt::Checked);
  return true;
}
}

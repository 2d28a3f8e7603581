// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Strokes/StrokeModel.h"

#include "Panel/Parts/Advice.h"
#include "Panel/Parts/NumberDelegate.h"

#include <vtkSMDoubleVectorProperty.h>

#include <QGuiApplication>
#include <QIcon>
#include <QPalette>

#include <glm/geometric.hpp>

#include <algorithm>
#include <string>
#include <utility>

namespace brainshift
{
namespace
{
constexpr double LeastLength = 0.01; // mm; at 0 a stroke would lose its direction
constexpr double MostLength = 10000.0;

QString nameOf(Tool tool)
{
  switch (tool)
  {
    case Tool::Move:
      return StrokeModel::tr("Move");
    case Tool::Soft:
      return StrokeModel::tr("Soft");
    case Tool::Stamp:
      return StrokeModel::tr("Stamp");
  }
  return {};
}

QString textOf(const glm::dvec3& position, int decimals)
{
  return QString("%1, %2, %3")
    .arg(position.x, 0, 'f', decimals)
    .arg(position.y, 0, 'f', decimals)
    .arg(position.z, 0, 'f', decimals);
}

bool hasNumber(const Stroke& stroke, int column)
{
  switch (column)
  {
    case StrokeModel::AmountColumn:
      return true;
    case StrokeModel::MajorColumn:
      return stroke.tool != Tool::Move;
    case StrokeModel::MinorColumn:
      return stroke.tool == Tool::Stamp;
    default:
      return false;
  }
}

double numberIn(const Stroke& stroke, int column)
{
  switch (column)
  {
    case StrokeModel::MajorColumn:
      return stroke.major;
    case StrokeModel::MinorColumn:
      return stroke.minor;
    default:
      return amountOf(stroke);
  }
}

double leastNumber(const Stroke& stroke, int column)
{
  const bool bothWays = column == StrokeModel::AmountColumn && stroke.tool == Tool::Stamp;
  return bothWays ? -MostLength : LeastLength;
}

int sideOf(int column)
{
  const bool isText = column == StrokeModel::ToolColumn || column == StrokeModel::WhereColumn;
  return int(isText ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter;
}

// Unit vector along which the amount is counted. Zero if the stroke has no direction.
glm::dvec3 directionOf(const Stroke& stroke)
{
  const glm::dvec3 along = stroke.tool == Tool::Stamp ? -stroke.axis : stroke.vector;
  const double length = glm::length(along);
  return length > 0.0 ? along / length : glm::dvec3(0.0);
}
}

double amountOf(const Stroke& stroke)
{
  return glm::dot(stroke.vector, directionOf(stroke));
}

Stroke withAmount(Stroke stroke, double amount)
{
  stroke.vector = amount * directionOf(stroke);
  return stroke;
}

StrokeModel::StrokeModel(vtkSMDoubleVectorProperty* strokes, Write write, QObject* parent)
  : QAbstractTableModel(parent)
  , Property(strokes)
  , WriteStrokes(std::move(write))
{
  this->update();
}

void StrokeModel::update()
{
  std::string problem;
  this->strokes(problem);
  this->Problem = QString::fromStdString(problem);
  const int rows = problem.empty()
    ? static_cast<int>(this->Property->GetNumberOfElements()) / NumbersPerStroke
    : 0;
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
  Q_EMIT this->updated();
}

void StrokeModel::setLatticeSpacing(double spacing)
{
  if (this->LatticeSpacing != spacing)
  {
    this->LatticeSpacing = spacing;
    this->update();
  }
}

void StrokeModel::setAppliedShares(const std::vector<double>& shares)
{
  if (this->AppliedShares != shares)
  {
    this->AppliedShares = shares;
    this->update();
  }
}

void StrokeModel::setReaches(const std::vector<double>& reaches)
{
  if (this->Reaches != reaches)
  {
    this->Reaches = reaches; // at each step of a drag: the strokes are not read again
    if (this->Rows > 0)
    {
      Q_EMIT this->dataChanged(
        this->index(0, ReachColumn), this->index(this->Rows - 1, ReachColumn));
    }
  }
}

// mm, with the sign of the amount. None for a disabled stroke.
std::optional<double> StrokeModel::reach(int row, const Stroke& stroke) const
{
  const std::size_t place = static_cast<std::size_t>(row);
  if (!stroke.enabled || place >= this->Reaches.size())
  {
    return std::nullopt;
  }
  return amountOf(stroke) < 0.0 ? -this->Reaches[place] : this->Reaches[place];
}

std::vector<Stroke> StrokeModel::strokes(std::string& problem) const
{
  const double* numbers = this->Property->GetElements();
  return strokesFromNumbers(
    std::vector<double>(numbers, numbers + this->Property->GetNumberOfElements()), problem);
}

Stroke StrokeModel::stroke(int row) const
{
  if ((row + 1) * NumbersPerStroke > static_cast<int>(this->Property->GetNumberOfElements()))
  {
    return {}; // the property is ahead of the model
  }
  const double* numbers = this->Property->GetElements() + row * NumbersPerStroke;
  std::string problem;
  const std::vector<Stroke> one =
    strokesFromNumbers(std::vector<double>(numbers, numbers + NumbersPerStroke), problem);
  return one.empty() ? Stroke() : one.front();
}

void StrokeModel::write(const std::function<void(std::vector<Stroke>&)>& edit, const QString& label)
{
  std::string problem;
  std::vector<Stroke> strokes = this->strokes(problem);
  if (problem.empty())
  {
    edit(strokes);
    this->WriteStrokes(strokes, label);
  }
}

void StrokeModel::setEnabled(const QList<int>& rows, bool enabled)
{
  this->write(
    [&rows, enabled](std::vector<Stroke>& strokes) {
      for (const int row : rows)
      {
        strokes.at(row).enabled = enabled;
      }
    },
    enabled ? tr("Enable Strokes") : tr("Disable Strokes"));
}

void StrokeModel::removeRowsOf(const QList<int>& rows)
{
  QList<int> fromLast = rows;
  std::sort(fromLast.begin(), fromLast.end(), std::greater<int>());
  this->write(
    [&fromLast](std::vector<Stroke>& strokes) {
      for (const int row : fromLast)
      {
        strokes.erase(strokes.begin() + row);
      }
    },
    tr("Delete Strokes"));
}

void StrokeModel::removeAll()
{
  this->WriteStrokes({}, tr("Reset All Strokes"));
}

int StrokeModel::rowCount(const QModelIndex& parent) const
{
  return parent.isValid() ? 0 : this->Rows;
}

int StrokeModel::columnCount(const QModelIndex& parent) const
{
  return parent.isValid() ? 0 : ColumnCount;
}

Qt::ItemFlags StrokeModel::flags(const QModelIndex& index) const
{
  Qt::ItemFlags flags = Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemNeverHasChildren;
  if (index.column() == ToolColumn)
  {
    flags |= Qt::ItemIsUserCheckable;
  }
  const Stroke stroke = this->stroke(index.row());
  const bool directed = directionOf(stroke) != glm::dvec3(0.0);
  if (hasNumber(stroke, index.column()) && (directed || index.column() != AmountColumn))
  {
    flags |= Qt::ItemIsEditable;
  }
  return flags;
}

QVariant StrokeModel::headerData(int section, Qt::Orientation orientation, int role) const
{
  static const char* const titles[ColumnCount] = { QT_TR_NOOP("Stroke"), QT_TR_NOOP("Amount"),
    QT_TR_NOOP("Reached"), QT_TR_NOOP("Along"), QT_TR_NOOP("Across"), QT_TR_NOOP("Position") };
  static const char* const tips[ColumnCount] = {
    QT_TR_NOOP("The place in the order, and the tool. The check mark enables the stroke."),
    QT_TR_NOOP("The displacement at the centre (mm). A Stamp pulls above 0 and pushes below 0."),
    QT_TR_NOOP("How far the tissue at the centre went (mm), at full Strength"),
    QT_TR_NOOP("Stamp: the reach along the push (mm). Soft: the radius (mm)."),
    QT_TR_NOOP("Stamp: the reach across the push (mm)"),
    QT_TR_NOOP("The position of the stroke: x, y, z (mm, world axes)"),
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

QVariant StrokeModel::data(const QModelIndex& index, int role) const
{
  const Stroke stroke = this->stroke(index.row());
  const int column = index.column();
  switch (role)
  {
    case Qt::DisplayRole:
      if (column == ReachColumn)
      {
        const std::optional<double> reached = this->reach(index.row(), stroke);
        return reached ? QString::number(*reached, 'f', 1) : QString();
      }
      return column == ToolColumn ? tr("%1 %2").arg(index.row() + 1).arg(nameOf(stroke.tool))
                                  : this->text(stroke, column);
    case Qt::EditRole:
      return hasNumber(stroke, column) ? QVariant(numberIn(stroke, column)) : QVariant();
    case Qt::CheckStateRole:
      return column == ToolColumn ? QVariant(stroke.enabled ? Qt::Checked : Qt::Unchecked)
                                  : QVariant();
    case Qt::DecorationRole:
      return this->advice(index.row(), column).isEmpty() ? QVariant()
                                                         : QIcon(":/BrainShift/warning.svg");
    case Qt::ToolTipRole:
      return this->toolTip(index.row(), column);
    case Qt::TextAlignmentRole:
      return sideOf(column);
    case Qt::ForegroundRole:
      return stroke.enabled ? QVariant()
                            : QGuiApplication::palette().brush(QPalette::Disabled, QPalette::Text);
    case NumberDelegate::LeastRole:
      return leastNumber(stroke, column);
    case NumberDelegate::MostRole:
      return MostLength;
    default:
      return {};
  }
}

QString StrokeModel::text(const Stroke& stroke, int column) const
{
  switch (column)
  {
    case WhereColumn:
      return textOf(stroke.anchor, 0);
    default:
      return hasNumber(stroke, column) ? QString::number(numberIn(stroke, column), 'f', 1)
                                       : QString();
  }
}

QString StrokeModel::advice(int row, int column) const
{
  const Stroke stroke = this->stroke(row);
  if (column == ReachColumn)
  {
    const std::optional<double> reached = this->reach(row, stroke);
    return reached ? reachAdvice(amountOf(stroke), *reached) : QString();
  }
  if (!hasNumber(stroke, column))
  {
    return {};
  }
  const double number = numberIn(stroke, column);
  if (column == AmountColumn)
  {
    const std::size_t place = static_cast<std::size_t>(row);
    return guardAdvice(
      number, place < this->AppliedShares.size() ? this->AppliedShares[place] : 1.0);
  }
  const QString name = column == MinorColumn ? tr("The reach across the push")
    : stroke.tool == Tool::Soft              ? tr("The radius")
                                             : tr("The reach along the push");
  return radiusAdvice(name, number, this->LatticeSpacing);
}

QString StrokeModel::toolTip(int row, int column) const
{
  const QString warning = this->advice(row, column);
  if (!warning.isEmpty())
  {
    return warning;
  }
  const Stroke stroke = this->stroke(row);
  QString tip = tr("%1 at %2 mm, displacement %3 mm")
                  .arg(nameOf(stroke.tool), textOf(stroke.anchor, 2), textOf(stroke.vector, 2));
  if (stroke.tool != Tool::Move)
  {
    tip += tr(", fullness %1 (sigma)").arg(stroke.sigma);
  }
  return stroke.enabled ? tip : tip + tr(" (disabled)");
}

bool StrokeModel::setData(const QModelIndex& index, const QVariant& value, int role)
{
  const int row = index.row();
  const int column = index.column();
  if (!this->checkIndex(index, CheckIndexOption::IndexIsValid))
  {
    return false;
  }
  if (role == Qt::CheckStateRole && column == ToolColumn)
  {
    this->setEnabled({ row }, value.toInt() == Qt::Checked);
    return true;
  }
  bool isNumber = false;
  const double number = value.toDouble(&isNumber);
  const Stroke before = this->stroke(row);
  if (role != Qt::EditRole || !isNumber || !(this->flags(index) & Qt::ItemIsEditable) ||
    number < leastNumber(before, column) || number > MostLength)
  {
    return false;
  }
  if (number == numberIn(before, column))
  {
    return true; // an editor that was opened and closed is no edit
  }
  this->write(
    [row, column, number](std::vector<Stroke>& strokes) {
      Stroke& stroke = strokes.at(row);
      switch (column)
      {
        case MajorColumn:
          stroke.major = number;
          break;
        case MinorColumn:
          stroke.minor = number;
          break;
        default:
          stroke = withAmount(stroke, number);
      }
    },
    tr("Change Stroke"));
  return true;
}
}

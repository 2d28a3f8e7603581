// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Landmarks/LandmarkModel.h"

#include "Interaction/Landmarks/LandmarkList.h"

#include <cmath>

namespace brainshift
{
namespace
{
QString millimetres(double value)
{
  return std::isfinite(value) ? QString::number(value, 'f', 2) : QString(QChar(0x2013));
}
}

LandmarkModel::LandmarkModel(LandmarkList* list, QObject* parent)
  : ListModel(
      {
        { tr("Landmark"),
          tr("Number, and name if a file gives one. The check mark lets the pair count."), true },
        { tr("Residual"),
          tr("Distance from the measured position to the position after the fit (mm)") },
        { tr("Left out"),
          tr("Leave-one-out error: distance from the measured position to the prediction of a fit "
             "without this pair (mm), before fold guard and mask. A pair that is switched off is "
             "always left out.") },
      },
      parent)
  , List(list)
{
  this->connect(list, &LandmarkList::changed, this, &LandmarkModel::announce);
  this->announce();
}

int LandmarkModel::count() const
{
  return this->List ? static_cast<int>(this->List->rows().size()) : 0;
}

bool LandmarkModel::isOn(int row) const
{
  return this->List && this->List->rows()[row].on;
}

void LandmarkModel::setOn(const QList<int>& rows, bool on)
{
  if (this->List)
  {
    this->List->setOn(rows, on);
  }
}

void LandmarkModel::removeRowsOf(const QList<int>& rows)
{
  if (this->List)
  {
    this->List->remove(rows);
  }
}

bool LandmarkModel::isBold(int row) const
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

QString LandmarkModel::warning(int row, int column) const
{
  return column == LeftOutColumn && this->isBold(row) ? this->toolTip(row, column) : QString();
}

QString LandmarkModel::toolTip(int row, int column) const
{
  const LandmarkRow& landmark = this->List->rows()[row];
  if (this->isBold(row))
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
    .arg(positionText(landmark.rest, 1), positionText(landmark.measured, 1),
      landmark.isPicked() ? tr("Picked in the window.") : tr("From a file."));
}
}

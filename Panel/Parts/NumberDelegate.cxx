// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Parts/NumberDelegate.h"

#include <QDoubleSpinBox>

namespace brainshift
{
QWidget* NumberDelegate::createEditor(
  QWidget* parent, const QStyleOptionViewItem&, const QModelIndex& index) const
{
  auto editor = new QDoubleSpinBox(parent);
  editor->setFrame(false);
  editor->setButtonSymbols(QAbstractSpinBox::NoButtons); // the cell is narrow
  editor->setDecimals(2);
  editor->setRange(index.data(LeastRole).toDouble(), index.data(MostRole).toDouble());
  return editor;
}
}

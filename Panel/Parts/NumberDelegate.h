// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Edits the numbers of a list, with 2 decimals, within limits that the model gives.
#ifndef BrainShift_NumberDelegate_h
#define BrainShift_NumberDelegate_h

#include <QStyledItemDelegate>

namespace brainshift
{
class NumberDelegate : public QStyledItemDelegate
{
  Q_OBJECT

public:
  /// What a model answers for a number: its limits.
  enum Role
  {
    LeastRole = Qt::UserRole,
    MostRole,
  };

  using QStyledItemDelegate::QStyledItemDelegate;

  QWidget* createEditor(
    QWidget* parent, const QStyleOptionViewItem& option, const QModelIndex& index) const override;
};
}

#endif

// SPDX-License-Identifier: BSD-3-Clause
#include "Panel/Measured/PullTree.h"

#include "Interaction/Commands/Commands.h"
#include "Panel/Measured/PullModel.h"
#include "Panel/Parts/NumberDelegate.h"
#include "Panel/Parts/SoftHighlight.h"

#include <QEvent>
#include <QHeaderView>
#include <QKeyEvent>
#include <QPainter>

#include <algorithm>

namespace brainshift
{
namespace
{
constexpr int FewestRows = 2; // seen at once
constexpr int MostRows = 7;
}

PullTree::PullTree(PullModel* model, QWidget* parent)
  : QTreeView(parent)
  , Pulls(model)
{
  this->setModel(model);
  this->setItemDelegate(new NumberDelegate(this));
  this->setRootIsDecorated(false);
  this->setUniformRowHeights(true);
  this->setAlternatingRowColors(true);
  this->setSelectionMode(QAbstractItemView::ExtendedSelection);
  this->setEditTriggers(QAbstractItemView::DoubleClicked | QAbstractItemView::EditKeyPressed |
    QAbstractItemView::AnyKeyPressed);
  this->setTabKeyNavigation(false); // Tab leaves the list
  this->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
  this->setTextElideMode(Qt::ElideRight);
  softenHighlight(this);
  QHeaderView* header = this->header();
  header->setStretchLastSection(true); // the position
  header->setMinimumSectionSize(this->fontMetrics().averageCharWidth() * 5);
  header->setSectionResizeMode(QHeaderView::ResizeToContents);
  header->setSectionsMovable(false);
  this->connect(this->selectionModel(), &QItemSelectionModel::selectionChanged, this,
    &PullTree::selectedRowsChanged);
  const auto fit = [this] {
    this->updateGeometry();
    this->showWhereIfRoom();
  };
  this->connect(model, &QAbstractItemModel::rowsInserted, this, fit);
  this->connect(model, &QAbstractItemModel::rowsRemoved, this, fit);
}

QList<int> PullTree::selectedRows() const
{
  QList<int> rows;
  for (const QModelIndex& index : this->selectionModel()->selectedRows())
  {
    rows.append(index.row());
  }
  return rows;
}

void PullTree::removeSelected()
{
  const QList<int> rows = this->selectedRows();
  if (!rows.isEmpty())
  {
    this->clearSelection(); // rows keep their number, not their pull
    this->Pulls->removeRowsOf(rows);
  }
}

void PullTree::moveColumn(int by)
{
  const QModelIndex next = this->currentIndex().siblingAtColumn(this->currentIndex().column() + by);
  if (next.isValid() && !this->isColumnHidden(next.column()))
  {
    this->selectionModel()->setCurrentIndex(next, QItemSelectionModel::NoUpdate);
  }
}

void PullTree::keyPressEvent(QKeyEvent* event)
{
  const KeyCommand found = commandOfKey({ Scope::List }, event->key());
  const QList<int> rows = this->selectedRows();
  switch (found.command)
  {
    case Command::DeleteStrokes:
      this->removeSelected();
      return;
    case Command::ToggleStrokes:
      if (!rows.isEmpty())
      {
        this->Pulls->setOn(rows, !this->Pulls->isOn(rows.front()));
      }
      return;
    case Command::ChooseNumber:
      this->moveColumn(found.place == 0 ? -1 : 1);
      return;
    case Command::EditNumber:
      if (this->currentIndex().flags() & Qt::ItemIsEditable)
      {
        this->edit(this->currentIndex());
      }
      return;
    default:
      this->QTreeView::keyPressEvent(event);
  }
}

void PullTree::resizeEvent(QResizeEvent* event)
{
  this->QTreeView::resizeEvent(event);
  this->showWhereIfRoom();
}

// A position that is cut off would read as another one. Tool tips show it as well.
void PullTree::showWhereIfRoom()
{
  int needed = this->fontMetrics().horizontalAdvance("-300, -300, 300");
  for (int column = 0; column < PullModel::WhereColumn; ++column)
  {
    needed += std::max(this->sizeHintForColumn(column), this->header()->sectionSizeHint(column));
  }
  const bool hidden = this->viewport()->width() < needed;
  this->setColumnHidden(PullModel::WhereColumn, hidden);
  this->header()->setSectionResizeMode(
    PullModel::KindColumn, hidden ? QHeaderView::Stretch : QHeaderView::ResizeToContents);
  this->header()->setStretchLastSection(!hidden);
}

void PullTree::changeEvent(QEvent* event)
{
  this->QTreeView::changeEvent(event);
  if (event->type() == QEvent::PaletteChange) // our own one, equal to the last, changes nothing
  {
    softenHighlight(this);
  }
}

void PullTree::paintEvent(QPaintEvent* event)
{
  this->QTreeView::paintEvent(event);
  if (this->Pulls->rowCount() == 0)
  {
    QPainter painter(this->viewport());
    painter.setPen(this->palette().color(QPalette::PlaceholderText));
    painter.drawText(this->viewport()->rect().adjusted(8, 0, -8, 0),
      Qt::AlignCenter | Qt::TextWordWrap, tr("There are no pulls or pins."));
  }
}

int PullTree::heightOfRows(int rows) const
{
  const int row = std::max(this->sizeHintForRow(0), this->fontMetrics().height() + 4);
  return rows * row + this->header()->sizeHint().height() + 2 * this->frameWidth();
}

QSize PullTree::sizeHint() const
{
  const int rows = std::clamp(this->Pulls->rowCount() + 1, FewestRows, MostRows);
  return { this->QTreeView::sizeHint().width(), this->heightOfRows(rows) };
}

QSize PullTree::minimumSizeHint() const
{
  return { 0, this->heightOfRows(FewestRows) };
}
}
